"""The guide as Sphinx writes it, and the manual pages: nothing missing, no link that leads nowhere, nothing fetched from a network."""

import functools
import html.parser
import importlib.util
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

from guide import PAGES, ROOT

sys.path.insert(0, str(ROOT / "tools/docs/ext"))

import reference  # noqa: E402, which lies beside the guide

ALL = "TALUS_NO_SKIP" in os.environ


class Links(html.parser.HTMLParser):
    def __init__(self):
        super().__init__()
        self.links, self.fetched, self.ids = [], [], set()

    def handle_starttag(self, tag, attributes):
        values = dict(attributes)
        self.ids.update(filter(None, [values.get("id")]))
        if tag == "a" and values.get("href"):
            self.links.append(values["href"])
        if tag in ("script", "img", "link", "iframe"):
            self.fetched += [value for value in (values.get("src"), values.get("href")) if value]


@functools.cache
def parsed(path):
    page = Links()
    page.feed(path.read_text(encoding="utf-8"))
    return page


@unittest.skipIf(not ALL and any(importlib.util.find_spec(name) is None for name in ("sphinx", "myst_parser", "furo")),
                 "python3-sphinx, python3-myst-parser or furo is not installed")
class Guide(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.html = pathlib.Path(cls.folder.name) / "html"
        subprocess.run([sys.executable, ROOT / "tools/docs/build.py", cls.html], check=True)  # warnings are errors

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_every_page_and_link(self):
        for source in PAGES:
            page = self.html / f"{source.stem}.html"
            self.assertTrue(page.exists(), source.stem)
            found = parsed(page)
            for link in found.links + found.fetched:
                with self.subTest(f"{source.stem}: {link}"):
                    if re.match(r"https?:|mailto:", link):
                        self.assertNotIn(link, found.fetched)
                        continue
                    file, _, anchor = link.partition("#")
                    target = page.parent / re.sub(r"\?.*", "", file) if file else page
                    self.assertTrue(target.exists())
                    if anchor and target.suffix == ".html":
                        self.assertIn(anchor, parsed(target).ids | {"top", ""})

    def test_the_reference_has_every_key_and_command(self):
        text = {name: (self.html / f"{name}.html").read_text(encoding="utf-8") for name in ("keys", "sweep-keys", "commands")}
        for what, name in (("scenario", "keys"), ("sweep", "sweep-keys")):
            for section in reference.sections(what):
                for key in section.keys:
                    self.assertIn(f'<span class="pre">{key.name.split("[")[0]}', text[name])
        for command in reference.commands():
            self.assertIn(f"<h2>talus {command}", text["commands"])

    def test_formulas_are_mathml(self):
        theory = (self.html / "theory.html").read_text(encoding="utf-8")
        self.assertGreater(theory.count("<math "), 40)
        self.assertFalse([each for each in parsed(self.html / "theory.html").fetched if "mathjax" in each.lower()])


class Manual(unittest.TestCase):
    @unittest.skipIf(not ALL and shutil.which("lexgrog") is None, "man-db is not installed")
    def test_pages(self):
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([sys.executable, ROOT / "tools/docs/man.py", os.environ["TALUS_PROGRAM"], folder], check=True)
            names = {path.name for path in pathlib.Path(folder).iterdir()}
            self.assertEqual(names, {"talus.1", *(f"talus-{command}.1" for command in reference.commands())})
            for path in pathlib.Path(folder).iterdir():
                with self.subTest(path.name):
                    found = subprocess.run(["lexgrog", path], capture_output=True, text=True, check=False)
                    self.assertIn(path.stem, found.stdout)
                    shown = subprocess.run(["man", "--warnings", "-l", path], capture_output=True, text=True, check=True,
                                           env={**os.environ, "MANPAGER": "cat", "MANWIDTH": "100"})
                    self.assertEqual(shown.stderr, "")
                    command = path.stem.removeprefix("talus").lstrip("-")
                    for option in re.findall(r"^  (--[a-z-]+)", reference.program(*filter(None, [command]), "--help"), re.M):
                        self.assertIn(option, shown.stdout)


if __name__ == "__main__":
    unittest.main()
