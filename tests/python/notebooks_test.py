"""The notebooks of bench/notebooks run to their end in a kernel of this Python, and show what they should."""

import os
import pathlib
import shutil
import sys
import unittest

from support import ROOT, Folder

try:
    import matplotlib  # noqa: F401, which the notebooks draw with
    import nbclient
    import nbformat
    from jupyter_client import KernelManager
    from jupyter_client.kernelspec import KernelSpec
except ImportError:  # Debian: python3-nbclient, python3-ipykernel, python3-matplotlib
    nbclient = None

SHOWN = {  # what a person sees of each
    "paper-slope": ["<svg", "<iframe", "image/png"],
    "bolted-rock-slope": ["<svg", "<iframe", "image/png"],
    "masonry-arch": ["<svg", "image/png", "unstable_at_start"],
}


def execute(path, folder):
    """The notebook with its outputs, run in a copy of its folder, so that what it writes stays out of the source."""
    for each in ("paper", "verification", "examples"):
        (folder / each).symlink_to(ROOT / "bench" / each)
    there = folder / "notebooks"
    there.mkdir()
    shutil.copy(path, there)
    manager = KernelManager()
    manager._kernel_spec = KernelSpec(argv=[sys.executable, "-m", "ipykernel_launcher", "-f", "{connection_file}"], language="python")
    book = nbformat.read(there / path.name, as_version=4)
    nbformat.validate(book)
    nbclient.NotebookClient(book, timeout=280, km=manager, resources={"metadata": {"path": str(there)}}).execute()
    return book


@unittest.skipIf(nbclient is None and "TALUS_NO_SKIP" not in os.environ, "python3-nbclient, python3-ipykernel or python3-matplotlib is not installed")
class Notebooks(unittest.TestCase):
    def test_each(self):
        books = sorted(pathlib.Path(ROOT / "bench/notebooks").glob("*.ipynb"))
        self.assertEqual([book.stem for book in books], sorted(SHOWN))
        only = os.environ.get("TALUS_NOTEBOOK")
        for path in books:
            if only in (None, path.stem):
                with self.subTest(path.stem), Folder() as folder:
                    (folder / "here").mkdir()
                    shown = str([cell.get("outputs") for cell in execute(path, folder / "here").cells])
                    for wanted in SHOWN[path.stem]:
                        self.assertIn(wanted, shown)


if __name__ == "__main__":
    unittest.main()
