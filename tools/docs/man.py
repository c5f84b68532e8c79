#!/usr/bin/env python3
"""Writes the manual pages talus.1, talus-run.1, ... from the program's own help texts: man.py PROGRAM FOLDER"""

import os
import pathlib
import re
import sys

sys.path.insert(0, str(pathlib.Path(__file__).parent / "ext"))
sys.dont_write_bytecode = True
os.environ["TALUS_PROGRAM"] = sys.argv[1]

import reference  # noqa: E402, which reads that variable

ENTRY = re.compile(r"^  (\S.*?)(?:\s{2,}(\S.*))?$")  # an option or a command, and what it does where both fit in a line

TITLES = {"Positionals:": "arguments", "Options:": "options", "Subcommands:": "commands"}


def roff(text):
    """Text that means nothing to the formatter."""
    text = text.replace("\\", "\\e").replace("-", "\\-")
    return "\n".join("\\&" + line if line[:1] in (".", "'") else line for line in text.splitlines())


def entries(lines):
    """(option, what it does) of a section of the help text; lines that are indented more go on with the last one."""
    found = []
    for line in lines:
        entry = ENTRY.match(line)
        if entry and not line.startswith("   "):
            found.append([entry[1], entry[2] or ""])
        elif found:
            found[-1][1] = f"{found[-1][1]} {line.strip()}".strip()
    return found


def list_of(title, lines):
    return [f".SH {title.upper()}"] + [
        part for name, text in entries(lines) for part in (".TP", f".B {roff(name)}", roff(text))
    ]


def paragraphs(lines):
    """The end of a help text: examples and what else is indented stand as they are."""
    result, section = [], ""
    for block in "\n".join(lines).strip().split("\n\n"):
        body = block.splitlines()
        title = "EXAMPLES" if body[0] in ("Example:", "Examples:") else "NOTES"
        result.append(".PP" if title == section else f".SH {title}")
        section = title
        for line in body[1:] if title == "EXAMPLES" else body:
            result += [".nf", roff(line), ".fi"] if line.startswith("  ") else [roff(line)]
    return result


def page(command, version):
    name = f"talus-{command}" if command else "talus"
    lines = reference.program(*filter(None, (command,)), "--help").splitlines()
    usage = next(k for k, line in enumerate(lines) if line.startswith("Usage: "))
    what = " ".join(lines[:usage]).strip()
    result = [f'.TH {name.upper()} 1 "" "{version}" "Talus"', ".SH NAME", f"{roff(name)} \\- {roff(what)}",
              ".SH SYNOPSIS", roff(lines[usage].removeprefix("Usage: "))]
    k = usage + 1
    while k < len(lines):
        title = TITLES.get(lines[k])
        if title:
            end = next((e for e in range(k, len(lines)) if not lines[e].strip()), len(lines))
            result += list_of(title, lines[k + 1 : end])
            k = end
        elif lines[k].strip():
            result += paragraphs(lines[k:])
            break
        else:
            k += 1
    others = "talus(1)" if command else ", ".join(f"talus\\-{roff(each)}(1)" for each in reference.commands())
    return "\n".join([*result, ".SH SEE ALSO", others]) + "\n"


def main():
    folder = pathlib.Path(sys.argv[2])
    folder.mkdir(parents=True, exist_ok=True)
    version = " ".join(reference.program("--version").split()[:2])
    for command in ("", *reference.commands()):
        (folder / f"{'-'.join(filter(None, ('talus', command)))}.1").write_text(page(command, version), encoding="utf-8")


main()
