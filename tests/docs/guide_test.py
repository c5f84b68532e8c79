"""Every code block of the guide and of the README runs as it stands there, each page in a folder of its own."""

import contextlib
import io
import os
import pathlib
import subprocess
import sys
import tempfile
import tomllib
import unittest

from guide import PAGES, ROOT, blocks

PROGRAM = os.environ["TALUS_PROGRAM"]
BUILD = pathlib.Path(os.environ["TALUS_BUILD_DIR"])
SLOW = "TALUS_SLOW_GUIDE" in os.environ
LANGUAGES = {"toml", "sh", "python", "text", "csv"}

try:
    import matplotlib

    matplotlib.use("svg")
except ImportError:  # Debian: python3-matplotlib
    matplotlib = None


class Page:
    """A folder in which the blocks of one page are run, as if it were the top of the source."""

    def __init__(self, folder):
        self.folder, self.names, self.printed = folder, {"__name__": "guide"}, ""
        for name, target in (("bench", ROOT / "bench"), ("build", BUILD), ("tools", ROOT / "tools")):
            (folder / name).symlink_to(target)
        self.environment = {**os.environ, "PATH": f"{pathlib.Path(PROGRAM).parent}:{os.environ['PATH']}", "MPLBACKEND": "svg"}

    def run(self, block):
        """What is wrong with a block, or nothing."""
        if "elsewhere" in block.told or ("slow" in block.told and not SLOW):
            return None
        if "file" in block.told:
            (self.folder / block.told["file"]).write_text(block.text, encoding="utf-8")
        if "output" in block.told:
            return self.compare(block.text)
        return getattr(self, block.language, lambda _: None)(block)

    def sh(self, block):
        done = subprocess.run(["bash", "-euo", "pipefail", "-c", block.text], cwd=self.folder, env=self.environment,
                              capture_output=True, text=True, stdin=subprocess.DEVNULL, check=False)
        self.printed = done.stdout
        wanted = int(block.told.get("exit", 0))
        return None if done.returncode == wanted else f"exit code {done.returncode}, not {wanted}\n{done.stderr}"

    def toml(self, block):
        name = self.folder / block.told.get("file", "together.toml")
        if "with" in block.told:
            name = self.folder / "together.toml"
            name.write_text((self.folder / block.told["with"]).read_text(encoding="utf-8") + block.text, encoding="utf-8")
        elif "file" not in block.told:
            name.write_text(block.text, encoding="utf-8")
        sweep = "scenario" in tomllib.loads(name.read_text(encoding="utf-8"))
        command = ["batch", name, "--plan"] if sweep else ["validate", name]
        done = subprocess.run([PROGRAM, *command, "--quiet"], cwd=self.folder, capture_output=True, text=True, check=False)
        return None if done.returncode == 0 else done.stderr

    def python(self, block):
        said = io.StringIO()
        with contextlib.chdir(self.folder), contextlib.redirect_stdout(said):
            exec(compile(block.text, f"{block.page}:{block.line}", "exec"), self.names)
        self.printed = said.getvalue()
        return None

    def compare(self, text):
        """Each line is one that was printed, spaces apart; dots in it stand for anything."""
        printed = [" ".join(line.split()) for line in self.printed.splitlines()]
        for line in filter(None, (" ".join(line.split()) for line in text.splitlines())):
            begin, dots, end = line.partition("...")
            if not any(each == line or dots and each.startswith(begin) and each.endswith(end) for each in printed):
                return f"not printed: {line}\n" + self.printed
        return None


class Guide(unittest.TestCase):
    maxDiff = None

    def check(self, page):
        found = blocks(page)
        for block in found:
            self.assertIn(block.language, LANGUAGES, f"{page.name}:{block.line}")
        if matplotlib is None and "TALUS_NO_SKIP" not in os.environ and any("matplotlib" in block.text for block in found):
            self.skipTest("python3-matplotlib is not installed")
        with tempfile.TemporaryDirectory() as folder:
            runner = Page(pathlib.Path(folder))
            for block in found:
                with self.subTest(f"{page.name}:{block.line}"):
                    fault = runner.run(block)
                    self.assertIsNone(fault, fault)


def _case(page):
    return lambda self: self.check(page)


for each in [ROOT / "README.md", *PAGES]:
    setattr(Guide, f"test_{each.stem.lower().replace('-', '_')}", _case(each))

if __name__ == "__main__":
    sys.dont_write_bytecode = True
    unittest.main()
