"""The two programs at the beginning of the guide's chapter on Python give what the chapter says; without matplotlib, too."""

import contextlib
import io
import os
import re
import sys
import types
import unittest
import unittest.mock

from support import ROOT, Folder


class Plot(types.ModuleType):
    """Stands for matplotlib.pyplot, which the package does not need: keeps what was drawn."""

    def __init__(self):
        super().__init__("matplotlib.pyplot")
        self.drawn = None

    def plot(self, x, y):
        self.drawn = list(x), list(y)

    def __getattr__(self, name):
        return lambda *arguments: None


class Chapter(unittest.TestCase):
    def test_ten_lines_and_a_model(self):
        codes = re.findall(r"```python\n(.*?)```", (ROOT / "tools/docs/python.md").read_text(), re.DOTALL)[:2]
        self.assertEqual(len(codes[0].splitlines()), 10)
        pyplot, matplotlib, said = Plot(), types.ModuleType("matplotlib"), io.StringIO()
        matplotlib.pyplot = pyplot
        with Folder() as files, unittest.mock.patch.dict(
            sys.modules, {"matplotlib": matplotlib, "matplotlib.pyplot": pyplot}
        ), contextlib.chdir(files.path), contextlib.redirect_stdout(said):
            os.symlink(ROOT / "bench", files / "bench")
            names = {}
            for code in codes:
                exec(compile(code, "python.md", "exec"), names)
        frictions, factors = pyplot.drawn
        self.assertEqual(frictions, [25, 30, 35, 40, 45])
        self.assertEqual(factors, sorted(factors))
        self.assertIn("sliding", said.getvalue())
        self.assertIn("(101, 2, 3)", said.getvalue())


if __name__ == "__main__":
    unittest.main()
