"""What words.py counts, and that it finds a page that is too long."""

import io
import contextlib
import pathlib
import subprocess
import tempfile
import unittest

import words


class Counts(unittest.TestCase):
    def test_sentences_end_at_full_stops_and_not_at_initials_or_decimals(self):
        self.assertEqual(words.sentences("One two three. Four five! Six (E. Riks, 1979) is 1.5 long?"), [3, 2, 7])

    def test_code_and_formulas_are_one_word_each_and_links_are_their_text(self):
        self.assertEqual(words.sentences("Call `a b c` with $x + y$ as [the page](there.md) says."), [8])

    def test_items_headings_and_tables_are_not_run_together(self):
        page = "# A heading\n\n- one two\n  three\n- four\n\n| a | b |\n|---|---|\n\n    code here\n\n```\ncode\n```\n"
        self.assertEqual(words.sentences(page), [3, 1])

    def test_percentiles(self):
        self.assertEqual(words.percentile(list(range(1, 11)), 0.5), 6)
        self.assertEqual(words.percentile(list(range(1, 11)), 0.9), 10)
        self.assertEqual(words.percentile([], 0.5), 0)


class Faults(unittest.TestCase):
    def test_a_long_line_is_one_only_in_prose(self):
        long = "word " * 21
        self.assertEqual(len(words.faults("a.md", long)), 1)
        for page in (f"```\n{long}\n```\n", f"text\n\n    {long}\n", f"| {long} |\n", f"<!-- {long} -->\n"):
            self.assertEqual(words.faults("a.md", page), [])
        self.assertEqual(len(words.faults("a.md", f"```\ncode\n```\n{long}\n")), 1)

    def test_limits_of_pages(self):
        self.assertEqual(words.faults("engine/README.md", "word\n" * 3000), [])
        self.assertEqual(len(words.faults("engine/README.md", "word\n" * 3001)), 1)
        self.assertEqual(words.faults("README.md", "word\n" * 120), [])
        self.assertEqual(len(words.faults("README.md", "word\n" * 121)), 1)


class Program(unittest.TestCase):
    def code_for(self, folder):
        with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()):
            return words.main(pathlib.Path(folder))

    def test_exit_codes(self):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            self.assertEqual(self.code_for(folder), 77)
            (folder / "engine").mkdir()
            (folder / "engine/README.md").write_text("Short.\n")
            (folder / "README.md").write_text("Short.\n")
            subprocess.run(["git", "init", "-q", name], check=True)
            subprocess.run(["git", "-C", name, "add", "README.md", "engine"], check=True)
            self.assertEqual(self.code_for(folder), 0)
            (folder / "README.md").write_text("word " * 30)
            self.assertEqual(self.code_for(folder), 1)
            (folder / "README.md").unlink()
            self.assertEqual(self.code_for(folder), 1)


if __name__ == "__main__":
    unittest.main()
