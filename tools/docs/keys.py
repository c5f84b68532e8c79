#!/usr/bin/env python3
"""Writes the tables of all keys into keys.md and sweep-keys.md, from the schemas of the program in TALUS_PROGRAM.

keys.py [--check]. With --check nothing is written; exit code 1 says that a page is not what the program's schemas say.
"""

import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE / "ext"))

import reference  # noqa: E402, which lies beside the guide

PAGES = {"keys.md": "scenario", "sweep-keys.md": "sweep"}
BEGIN = "<!-- written by tools/docs/keys.py: begin -->"
END = "<!-- end -->"


def cell(text):
    return text.replace("|", "\\|")


def row(key):
    kind = f"{key.kind}{', required' if key.required else ''}"
    allowed = "; ".join(part for part in (key.allowed, key.unit) if part)
    return f"| `{key.name}` | {cell(kind)} | {cell(allowed)} | {cell(key.meaning)} |"


def sentence(text):
    return text[0].upper() + text[1:] + "."


def wrapped(text, columns=100):
    lines = [""]
    for word in text.split():
        longer = f"{lines[-1]} {word}".strip()
        lines = [*lines[:-1], longer] if len(longer) <= columns else [*lines, word]
    return "\n".join(lines)


def section(found):
    parts = [f"## `{found.header}`" if found.header else "## Above all sections"]
    if found.meaning:
        parts.append(wrapped(sentence(found.meaning)))
    if found.keys:
        parts.append("\n".join(["| key | kind | allowed; unit | meaning |", "|---|---|---|---|", *map(row, found.keys)]))
    return "\n\n".join(parts)


def page(name):
    """The page's text, its tables as the program's schema has them."""
    text = (HERE / name).read_text(encoding="utf-8")
    before, after = text.partition(BEGIN)[0], text.partition(END)[2]
    tables = "\n\n".join(section(each) for each in reference.sections(PAGES[name]))
    return f"{before}{BEGIN}\n\n{tables}\n\n{END}{after}"


def main():
    stale = [name for name in PAGES if page(name) != (HERE / name).read_text(encoding="utf-8")]
    if "--check" in sys.argv[1:]:
        for name in stale:
            print(f"tools/docs/{name} is not current: TALUS_PROGRAM=build/tools/talus tools/docs/keys.py", file=sys.stderr)
        sys.exit(1 if stale else 0)
    for name in stale:
        (HERE / name).write_text(page(name), encoding="utf-8")


if __name__ == "__main__":
    main()
