#!/usr/bin/env python3
"""Free surfaces in networks drawn at random, each solved twice: the second time with a viscosity larger by 1e-12.

Draws dams with and without drains, slopes between two joint sets, and boxes in space between three. Prints the
networks that are refused, those whose discharge differs by more than 1e-6, and the sum of the iterations.

    bench/studies/free_surfaces.py PROGRAM [--count 72] [--seed 1000] [--write FOLDER]
"""

import argparse
import json
import pathlib
import random
import subprocess
import tempfile

ROCK = """[material.rock]
density = 2600.0
[joint.default]
friction_deg = 35.0
normal_stiffness = 1e10
shear_stiffness = 1e9
"""
MOVED = 1 + 1e-12
SAME = 1e-6  # of the discharge


def boundary(name, **keys):
    return f'[[flow.boundary]]\nname = "{name}"\n' + "".join(f"{key} = {value}\n" for key, value in keys.items())


def low_end(draw, low):
    if draw.random() < 0.5:
        return boundary("low", face='"-x"', head=low)
    return boundary("low", face='"-x"', outlet="true")


def dam(draw, has_drain):
    columns, rows = draw.randint(6, 16), draw.randint(5, 14)
    length, height = round(draw.uniform(0.3, 1.2), 3), round(draw.uniform(0.3, 1.2), 3)
    upstream = round(draw.uniform(0.5, 0.95) * rows * height, 3)
    low = round(draw.uniform(0.05, 0.4) * upstream, 3)
    text = (f"{ROCK}[[stack]]\ncolumns = {columns}\nrows = {rows}\nslices = 1\n"
            f"block = [{length:g}, 1.0, {height:g}]\n[flow]\naperture = 1e-4\n")
    if has_drain:
        x, z = draw.randint(1, columns - 1) * length, draw.randint(0, max(0, rows // 4)) * height
        text += boundary("drain", outlet="true", box=f"{{ min = [{x - 0.01:g}, -1, {z - 0.01:g}], "
                                                     f"max = [{x + 0.01:g}, 2, {z + 0.01:g}] }}")
    return text + boundary("high", face='"+x"', head=upstream) + low_end(draw, low)


def joint_set(draw, dips, direction, spacings):
    text = (f'[[joint_set]]\nname = "s{direction}"\ndip_deg = {draw.uniform(*dips):g}\n'
            f"dip_direction_deg = {direction}\nspacing = {draw.uniform(*spacings):g}\n")
    if draw.random() < 0.6:
        text += f'spacing_law = "uniform"\nspacing_spread = {draw.uniform(0.1, 0.35):g}\n'
    return text


def slope(draw):
    head = draw.uniform(6.5, 10.5)
    return (f"{ROCK}[rock_mass]\n"
            "region = { y = [0, 1], profile = [[0, -2], [18, -2], [18, 12], [6, 12], [0, 0]] }\n"
            'fixed = [{ boundary = "-z" }, { boundary = "+x" }]\nmin_thickness = 0.001\n'
            + joint_set(draw, (5, 35), 270, (0.6, 1.4)) + joint_set(draw, (60, 88), 90, (0.6, 1.4))
            + "[flow]\naperture = 1e-4\n"
            + boundary("behind", box="{ min = [16, 0, -2], max = [18, 1, 12] }", head=head)
            + boundary("face", face='"-x"', outlet="true") + boundary("top", face='"+z"', outlet="true"))


def box(draw):
    x, y, z = draw.uniform(7, 12), draw.uniform(5, 8), draw.uniform(6, 9)
    upstream = draw.uniform(0.55, 0.85) * z
    low = draw.uniform(0.05, 0.4) * upstream
    return (f"{ROCK}[rock_mass]\nregion = {{ box = {{ min = [0, 0, 0], max = [{x:g}, {y:g}, {z:g}] }} }}\n"
            'fixed = [{ boundary = "-z" }]\nmin_thickness = 0.001\n'
            + joint_set(draw, (5, 30), 270, (1.2, 2.2)) + joint_set(draw, (70, 88), 90, (1.2, 2.2))
            + joint_set(draw, (75, 89), 0, (1.5, 3)) + "[flow]\naperture = 1e-4\n"
            + boundary("high", face='"+x"', head=upstream) + low_end(draw, low))


KINDS = [lambda draw: dam(draw, False), lambda draw: dam(draw, True), slope, slope, box, box]


def flow(program, path, text):
    """The answer, or why there is none."""
    path.write_text(text)
    done = subprocess.run([program, "flow", path, "--json"], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        return next((line for line in done.stderr.splitlines() if "error" in line), "no answer")
    return json.loads(done.stdout)


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("program")
    options.add_argument("--count", type=int, default=72)
    options.add_argument("--seed", type=int, default=1000)
    options.add_argument("--write", help="keep the scenarios in this folder")
    given = options.parse_args()
    folder = pathlib.Path(given.write or tempfile.mkdtemp())
    folder.mkdir(parents=True, exist_ok=True)
    refused = moved = iterations = 0
    for k in range(given.count):
        text = KINDS[k % len(KINDS)](random.Random(given.seed + k))
        viscosity = f"aperture = 1e-4\nviscosity = {1.307e-3 * MOVED:.17g}"
        found = flow(given.program, folder / f"{k}.toml", text)
        again = flow(given.program, folder / f"{k}-moved.toml", text.replace("aperture = 1e-4", viscosity))
        if isinstance(found, str) or isinstance(again, str):
            refused += 1
            print(k, found if isinstance(found, str) else again)
            continue
        iterations += found["iterations"]
        change = abs(again["inflow_m3_s"] / found["inflow_m3_s"] - 1)
        if change > SAME:
            moved += 1
            print(f"{k}: another answer, discharge {100 * change:.2g} %")
    print(f"{given.count} networks: {refused} refused, {moved} with another answer, {iterations} iterations")


if __name__ == "__main__":
    main()
