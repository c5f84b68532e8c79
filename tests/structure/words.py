#!/usr/bin/env python3
"""How long the project's pages, sentences and lines are.

words.py [FOLDER] prints, for each Markdown file that git knows in the folder: words, the median and the 90th percentile of
words per sentence, and the longest line. Then it prints how many lines of C++ are longer than 110 columns, file by file.

Exit code 1: a page is longer than LIMITS allow, or a line of Markdown is longer than 100 columns. Code, tables and
comments have no such limit: there a line cannot be broken. Exit code 77: the folder is not a git checkout.
"""

import pathlib
import re
import subprocess
import sys

COLUMNS = 100  # of Markdown
CPP_COLUMNS = 110  # of C++, as .clang-format has it
LIMITS = {  # file: (what is counted, how many of it are allowed)
    "engine/README.md": ("words", 3000),
    "README.md": ("lines", 120),
}

FENCE = re.compile(r"^\s*(```|~~~)")
TABLE = re.compile(r"^\s*\|")
ITEM = re.compile(r"^\s*(?:[-*+]|\d+\.)\s+")
# A sentence ends where a full stop, question mark or exclamation mark is followed by a space and a capital, a digit, or a
# mark that opens. A single capital before the full stop is an initial: "E. Riks".
END = re.compile(r"(?<![\s(.][A-Z])(?<!^[A-Z])[.!?][)\"*_]*\s+(?=[A-Z0-9(\"*_`\[$])")


def prose(text):
    """The (number, line) pairs of a page outside code blocks, formulas, comments and tables."""
    fence, formula, comment, indented, before = None, False, False, False, ""
    for number, line in enumerate(text.splitlines(), 1):
        found = FENCE.match(line)
        indented = line.startswith("    ") and (indented or not before.strip())
        before = line
        if fence is None and comment:
            comment = "-->" not in line
        elif found and fence in (None, found[1]):
            fence = None if fence else found[1]
        elif fence is None and line.strip().startswith("<!--"):
            comment = "-->" not in line
        elif fence is None and line.count("$$") % 2:
            formula = not formula
        elif fence is None and not formula and not indented and not TABLE.match(line):
            yield number, line


def sentences(text):
    """The number of words of each sentence of a page; code and formulas in a sentence are a word each."""
    paragraphs, open_ = [], False
    for _, line in prose(text):
        starts_item = ITEM.match(line)
        if not line.strip() or line.startswith("#"):
            open_ = False
            continue
        if starts_item or not open_:
            paragraphs.append("")
        paragraphs[-1] += " " + ITEM.sub("", line).strip()
        open_ = True
    counts = []
    for paragraph in paragraphs:
        paragraph = re.sub(r"!\[[^\]]*\]\([^)]*\)", "", paragraph)  # a picture
        paragraph = re.sub(r"\[([^\]]*)\]\([^)]*\)", lambda link: link[1] or "page", paragraph)
        paragraph = re.sub(r"`[^`]*`", "code", re.sub(r"\$\$?[^$]+\$\$?", "formula", paragraph))
        for sentence in END.split(paragraph.strip()):
            words = [word for word in sentence.split() if re.search(r"\w", word)]
            if words:
                counts.append(len(words))
    return counts


def percentile(counts, share):
    return sorted(counts)[min(len(counts) - 1, int(share * len(counts)))] if counts else 0


def faults(name, text):
    """What is wrong with a page, one sentence each."""
    found = []
    if name in LIMITS:
        unit, most = LIMITS[name]
        count = len(text.split()) if unit == "words" else len(text.splitlines())
        if count > most:
            found.append(f"{name}: {count} {unit}, at most {most} are allowed")
    for number, line in prose(text):
        if len(line) > COLUMNS:
            found.append(f"{name}:{number}: {len(line)} columns, at most {COLUMNS} are allowed")
    return found


def files(folder, *patterns):
    command = ["git", "-C", str(folder), "ls-files", "-z", "--", *patterns]
    listed = subprocess.run(command, capture_output=True, check=True).stdout.decode()
    return [name for name in listed.split("\0") if name and (folder / name).is_file()]


def main(folder):
    try:
        pages, sources = files(folder, "*.md"), files(folder, "*.h", "*.cpp")
    except (OSError, subprocess.CalledProcessError):
        print(f"{folder}: not a git checkout, so nothing is counted")
        return 77
    wrong = [f"{name}: there is no such page" for name in LIMITS if name not in pages]
    print(f"{'words':>6} {'median':>6} {'p90':>4} {'line':>5}")
    for name in pages:
        text = (folder / name).read_text(encoding="utf-8")
        counts = sentences(text)
        longest = max((len(line) for _, line in prose(text)), default=0)
        median, p90 = percentile(counts, 0.5), percentile(counts, 0.9)
        print(f"{len(text.split()):6} {median:6} {p90:4} {longest:5}  {name}")
        wrong += faults(name, text)
    print(f"\nlines of C++ longer than {CPP_COLUMNS} columns")
    total = 0
    for name in sources:
        lines = (folder / name).read_text(encoding="utf-8").splitlines()
        if count := sum(len(line) > CPP_COLUMNS for line in lines):
            print(f"{count:6}  {name}")
            total += count
    print(f"{total:6}  in all")
    for sentence in wrong:
        print(f"error: {sentence}", file=sys.stderr)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ".").resolve()))
