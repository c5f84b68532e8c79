"""The report from Python: the command line's page, well formed, with nothing that it fetches."""

import csv
import html.parser
import os
import re
import unittest
import xml.etree.ElementTree

import talus
from support import ROOT, Folder, of_the_slope, talus as program

SLOPE = os.path.join(ROOT, "bench/examples/rock-slope.toml")
VOID = {"meta", "br", "hr", "img", "link", "input"}


class Page(html.parser.HTMLParser):
    """Tags in pairs, ids once, and what would be fetched."""

    def __init__(self, text):
        super().__init__()
        self.open, self.ids, self.fetched, self.faults = [], [], [], []
        self.feed(text)
        self.close()
        self.faults += self.open

    def handle_starttag(self, tag, attributes):
        values = dict(attributes)
        self.ids += filter(None, [values.get("id")])
        self.fetched += [value for name, value in attributes if name in ("src", "href", "data", "action", "xlink:href")]
        self.faults += ["script"] if tag == "script" else []
        if tag not in VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag, attributes):
        self.handle_starttag(tag, attributes)
        if tag not in VOID:
            self.open.pop()

    def handle_endtag(self, tag):
        if not self.open or self.open.pop() != tag:
            self.faults.append(f"</{tag}> at {self.getpos()}")


def read(path):
    with open(path, encoding="utf-8") as stream:
        return stream.read()


class Report(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = Folder()
        cls.files = cls.folder.__enter__()
        cls.result = talus.report(SLOPE, cls.files / "slope.html", threads=1)
        cls.text = read(cls.files / "slope.html")

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_the_page_is_well_formed_and_fetches_nothing(self):
        page = Page(self.text)
        self.assertEqual(page.faults, [])
        self.assertEqual(page.fetched, [])
        self.assertEqual(len(page.ids), len(set(page.ids)))
        self.assertIn("answer", page.ids)
        self.assertIn("figure-slope", page.ids)
        self.assertEqual(set(re.findall(r"https?://[^\"<> ]*", self.text)), {"http://www.w3.org/2000/svg"})
        self.assertNotRegex(self.text, r"url\((?!#)")

    def test_figures_are_svg_and_tables(self):
        self.assertEqual(len(self.result.figures), 10)
        for file in self.result.figures:
            with self.subTest(file):
                if file.endswith(".svg"):
                    self.assertTrue(xml.etree.ElementTree.fromstring(read(file)).tag.endswith("svg"))
                else:
                    rows = list(csv.reader(line for line in read(file).splitlines() if not line.startswith("#")))
                    self.assertGreater(len(rows), 1)
                    self.assertEqual({len(row) for row in rows}, {len(rows[0])})

    def test_the_picture_in_the_page_is_that_of_the_file(self):
        for svg in re.findall(r"<svg id=.*?</svg>", self.text, re.DOTALL):
            xml.etree.ElementTree.fromstring(svg)

    def test_it_is_that_of_the_command_line(self):
        there = self.files / "there.html"
        beside = program("report", SLOPE, "-o", there, "--figures", self.files / "there")
        ours = of_the_slope(self.result.search.to_dict())
        self.assertEqual(ours, of_the_slope(beside["search"]))
        self.assertEqual(self.result.analysis, beside["analysis"])
        command = re.compile(r"<dt>command line</dt><dd>[^<]*</dd>")
        self.assertEqual(command.sub("", read(there)), command.sub("", self.text))

    def test_faults(self):
        for wrong in ({"analysis": "run"}, {"slope": (95, 270)}, {"sensitivity": 95}):
            with self.subTest(str(wrong)), self.assertRaises(talus.ScenarioError):
                talus.report(SLOPE, self.files / "none.html", **wrong)
        with self.assertRaises(talus.ScenarioError):
            talus.report(SLOPE, self.files / "none.pdf")
        self.assertFalse(os.path.exists(self.files / "none.html"))


if __name__ == "__main__":
    unittest.main()
