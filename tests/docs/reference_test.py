"""The guide's reference has every section and key that the reader knows, each explained, and no other."""

import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

from guide import ROOT

sys.path.insert(0, str(ROOT / "tools/docs/ext"))

import reference  # noqa: E402, which lies beside the guide

PROGRAM = os.environ["TALUS_PROGRAM"]


def allowed(text):
    """What the reader says is allowed in place of an unknown key: its own list."""
    with tempfile.NamedTemporaryFile("w", suffix=".toml") as file:
        file.write(text)
        file.flush()
        said = subprocess.run([PROGRAM, "validate", file.name], capture_output=True, text=True, check=False).stderr
    lines = [line for line in said.splitlines() if "zzzzzz" in line]
    assert len(lines) == 1, said
    return set(re.findall(r"[a-z_0-9]+", lines[0].partition("allowed:")[2]))


class Reference(unittest.TestCase):
    def test_sections_are_the_readers(self):
        known = allowed("zzzzzz = 1\n")
        named = {re.sub(r"[\[\]]|\.NAME", "", section.header) for section in reference.sections("scenario")} - {""}
        self.assertLessEqual(named, known)
        self.assertEqual(known - named - {"format"}, set())

    def test_keys_are_the_readers(self):
        for section in reference.sections("scenario"):
            if not section.header:
                continue
            header = section.header.replace("NAME", "default")
            before = "" if "rock_mass" in header else "[rock_mass]\n"  # some sections are read beside one only
            known = allowed(f"{before}{header}\nzzzzzz = 1\n")
            keys = {key.name for key in section.keys if "." not in key.name}
            with self.subTest(section.header):
                self.assertEqual(keys - known, set())
                self.assertLessEqual(len(known - keys), 1)  # words of the sentence that are no keys

    def test_everything_is_explained(self):
        for what in ("scenario", "sweep"):
            for section in reference.sections(what):
                with self.subTest(section.header):
                    self.assertTrue(section.meaning or not section.header)
                    for key in section.keys:
                        self.assertTrue(key.meaning, key.name)
                        self.assertTrue(key.kind, key.name)

    def test_the_pages_in_the_repository_are_current(self):
        said = subprocess.run([sys.executable, ROOT / "tools/docs/keys.py", "--check"], capture_output=True, text=True, check=False)
        self.assertEqual(said.stderr, "")

    def test_some_rows(self):
        rows = {f"{section.header} {key.name}": key for section in reference.sections("scenario") for key in section.keys}
        friction = rows["[joint.NAME] friction_deg"]
        self.assertEqual((friction.kind, friction.allowed, friction.unit), ("number", "at least 0, below 90", "deg"))
        self.assertTrue(rows["[[stack]] columns"].required)
        self.assertEqual(rows["[[bolt]] shear_stiffness"].unit, "N/m")
        self.assertEqual(rows["[[block]] box.min"].kind, "3 numbers")
        self.assertIn("[[load]] box.max", rows)
        self.assertEqual(rows["[contact] points"].unit, "")


if __name__ == "__main__":
    unittest.main()
