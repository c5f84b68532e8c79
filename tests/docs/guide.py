"""The guide's pages taken apart into their code blocks, and how each kind of block is run.

A block is fenced and says its language. Comments before it, which readers do not see, say the rest:

    <!-- file: NAME -->        the block is this file of the page's folder, from then on
    <!-- with: NAME -->        the block stands behind what is in this file; both together are read
    <!-- output -->            the block is what the last commands print (words in their order)
    <!-- exit: N -->           the commands end with this code
    <!-- slow -->              run only where TALUS_SLOW_GUIDE is set
    <!-- elsewhere: WHERE -->  run by another test, which this names

sh is run by bash, python by this Python, one page's blocks in one namespace; toml is read as a scenario, or planned as a sweep.
"""

import collections
import pathlib
import re

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGES = sorted(path for path in (ROOT / "tools/docs").glob("*.md") if path.name != "README.md")

Block = collections.namedtuple("Block", "page line language text told")

FENCE = re.compile(r"^```(\{?)([\w-]*)\}?(.*)$")
TOLD = re.compile(r"^<!-- (file|with|output|exit|slow|elsewhere)(?:: *(.*?))? -->$")
SHOWN = ("commands", "toctree", "literalinclude")  # Sphinx's own, not code


def blocks(page):
    """All code blocks of a page, in their order."""
    told, found, lines = {}, [], enumerate(page.read_text(encoding="utf-8").splitlines(), 1)
    for number, line in lines:
        comment, fence = TOLD.match(line), FENCE.match(line)
        if comment:
            told[comment[1]] = comment[2] or ""
        elif fence:
            body = []
            for _, inner in lines:
                if inner.startswith("```"):
                    break
                body.append(inner)
            if fence[2] not in SHOWN:
                found.append(Block(page, number, fence[2], "\n".join(body) + "\n", told))
            told = {}
        elif line.strip() and told:
            raise ValueError(f"{page}:{number}: {told} before something that is no code block")
    return found
