#!/usr/bin/env python3
"""How far answers move when a constant of the searches is halved or doubled.

Takes each `constexpr` number of the given folders, writes half and double of it into a copy of the tree, builds the
program there and repeats the quick searches of tests/determinism/answers.csv. Prints a table in Markdown: per
constant the largest change of an answer, how many verdicts changed, and the work (factorisations) against before.

    bench/studies/constants.py COPY [--in FOLDER ...] [--only REGEX] [--seconds S]

COPY is a checkout of its own with a configured build folder; its sources change while this runs, and are put back.
Takes one build of one or two files and one pass of the searches for each of the two values: hours for all folders.
"""

import argparse
import json
import pathlib
import re
import subprocess
import sys
import time

FOLDERS = ["engine/src/search", "engine/src/equilibrium", "engine/src/failure"]
NUMBER = r"[-+]?[0-9][0-9']*(?:\.[0-9]*)?(?:e[-+]?[0-9]+)?"
DECLARATION = re.compile(
    r"constexpr (?:double|int|float|unsigned|std::size_t|std::u?int(?:32|64)_t) (k[^;]*);")
ONE = re.compile(rf"(k[A-Z]\w*) = ({NUMBER})(?=[,]|$)")
# Layouts of memory, units and mathematical constants: half of them is no program.
NO_CHOICE = re.compile(
    r"kStiffness\w*|kBlock|kColumn|kSix|kDegree|kInDegrees|kWidest|kWidth|kGroupsAtOnce|kPath|kLoading")


def constants(root, folders):
    """(file, start, end, name, value) of each number."""
    for folder in folders:
        for path in sorted(pathlib.Path(root, folder).rglob("*")):
            if path.suffix not in (".h", ".cpp"):
                continue
            text = path.read_text()
            for declaration in DECLARATION.finditer(text):
                for one in ONE.finditer(declaration.group(1)):
                    if not NO_CHOICE.fullmatch(one.group(1)):
                        begin = declaration.start(1) + one.start(2)
                        yield path, begin, begin + len(one.group(2)), one.group(1), one.group(2)


def scaled(number, factor):
    """The literal times a factor; a whole number stays one and changes by at least one."""
    plain = number.replace("'", "")
    if re.fullmatch(r"[-+]?[0-9]+", plain):
        old = int(plain)
        new = round(old * factor)
        return str(new if new != old else old + (1 if factor > 1 else -1))
    return repr(float(plain) * factor)


def searches(root):
    for line in pathlib.Path(root, "tests/determinism/answers.csv").read_text().splitlines()[1:]:
        command, scenario = line.split(",")[:2]
        if command != "run":
            yield command, scenario


def ask(root, command, scenario, timeout):
    program = pathlib.Path(root, "build/tools/talus")
    try:
        done = subprocess.run(
            [program, command, scenario, "--json", "--quiet", "--threads", "1", "--no-upper-bound"],
            cwd=root, capture_output=True, text=True, timeout=timeout, check=False)
    except subprocess.TimeoutExpired:
        return {"status": "too long", "answer": None, "low": None, "work": 0}
    try:
        found = json.loads(done.stdout)
    except json.JSONDecodeError:
        return {"status": f"exit code {done.returncode}", "answer": None, "low": None, "work": 0}
    answer = next((found[key] for key in ("critical_angle_deg", "safety_factor", "critical_acceleration")
                   if found.get(key) is not None), None)
    interval = found.get("answer_interval") or found.get("answer_interval_deg") or [None, None]
    return {"status": found.get("status"), "answer": answer, "low": interval[0],
            "work": found.get("factorizations", found.get("factorisations", 0)) or 0}


def change(before, now):
    return abs(now / before - 1) if before and now is not None else 0.0


def measure(root, cases, usual, timeout):
    """(largest change of an answer, its case, largest change of a low end, verdicts changed, work share)"""
    most, where, low, verdicts, work, work_before, too_long = 0.0, "", 0.0, [], 0, 0, 0
    for case in cases:
        now, before = ask(root, *case, timeout), usual[case]
        too_long += now["status"] == "too long"
        if too_long > 2:
            verdicts.append("and further ones too long")
            break
        work += now["work"]
        work_before += before["work"]
        if now["status"] != before["status"]:
            verdicts.append(f"{case[1].split('/')[-1]}: {now['status']}")
            continue
        moved = change(before["answer"], now["answer"])
        if moved > most:
            most, where = moved, case[1].split("/")[-1]
        low = max(low, change(before["low"], now["low"]))
    return most, where, low, verdicts, work / max(1, work_before)


def build(root):
    done = subprocess.run(["ninja", "-C", "build", "tools/talus"], cwd=root, capture_output=True, text=True,
                          check=False)
    return done.returncode == 0


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("copy", help="checkout with a configured folder build/")
    options.add_argument("--in", dest="folders", nargs="+", default=FOLDERS)
    options.add_argument("--only", default="", help="names that match")
    options.add_argument("--seconds", type=float, default=0.5, help="searches that take longer are left out")
    given = options.parse_args()
    root = pathlib.Path(given.copy).resolve()
    if not build(root):
        sys.exit("the copy does not build as it is")
    usual, cases = {}, []
    for case in searches(root):
        begin = time.monotonic()
        found = ask(root, *case, 20 * given.seconds)
        if time.monotonic() - begin <= given.seconds:
            usual[case] = found
            cases.append(case)
    print(f"{len(cases)} searches, each of at most {given.seconds} s.\n")
    print("| constant | in | value | times | largest change of an answer | of a low end | verdicts changed | work |")
    print("|---|---|---:|---:|---|---:|---|---:|")
    for path, begin, end, name, value in list(constants(root, given.folders)):
        if not re.search(given.only, name):
            continue
        text = path.read_text()
        for factor in (0.5, 2):
            row = f"| `{name}` | {path.relative_to(root / 'engine/src')} | {value} | {factor} |"
            try:
                path.write_text(text[:begin] + scaled(value, factor) + text[end:])
                if build(root):
                    most, where, low, verdicts, work = measure(root, cases, usual, 20 * given.seconds)
                    row += (f" {100 * most:.2f} % {where} | {100 * low:.2f} % | {'; '.join(verdicts) or 'none'} |"
                            f" {work:.2f} |")
                else:
                    row += " does not compile | | | |"
            finally:
                path.write_text(text)
            print(row, flush=True)


if __name__ == "__main__":
    main()
