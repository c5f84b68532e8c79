#!/usr/bin/env python3
"""Writes a valley side of 100 x 100 m as a grid of 20,000 triangles, and its scenario with three joint sets.

    bench/rock_mass/terrain.py FOLDER [DEVIATION]
    /usr/bin/time -v talus safety-factor FOLDER/terrain.toml --threads 1

45 m high over 60 m, with half a metre of roughness in waves of some 12 m and longer. The surface is simplified to DEVIATION
(m, default 0.2; 0 leaves it as it is).
"""
import argparse
import math
import pathlib
import random

SIDES = 100  # of a metre
WAVES = 25

parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument("folder", type=pathlib.Path, metavar="FOLDER")
parser.add_argument("deviation", type=float, nargs="?", default=0.2, metavar="DEVIATION")
arguments = parser.parse_args()
folder, deviation = arguments.folder, arguments.deviation
folder.mkdir(parents=True, exist_ok=True)
random.seed(5)
waves = [(random.uniform(0.05, 0.5), random.uniform(0, 2 * math.pi), random.uniform(0, 2 * math.pi)) for _ in range(WAVES)]


def height(x, y):
    rough = sum(math.cos(k * (x * math.cos(a) + y * math.sin(a)) + phase) / (1 + 8 * k) for k, a, phase in waves)
    return 45 * max(0, min(1, (x - 20) / 60)) + 0.5 * rough


with open(folder / "terrain.asc", "w") as grid:
    grid.write(f"ncols {SIDES + 1}\nnrows {SIDES + 1}\nxllcorner 0\nyllcorner 0\ncellsize 1\nNODATA_value -9999\n")
    for y in range(SIDES, -1, -1):
        grid.write(" ".join(f"{height(x, y):.4f}" for x in range(SIDES + 1)) + "\n")

simplify = f", simplify = {deviation:g}" if deviation > 0 else ""
sets = "".join(f"""
[[joint_set]]
name = "{name}"
dip_deg = {dip}
dip_direction_deg = {direction}
spacing = {spacing}
""" for name, dip, direction, spacing in (("bedding", 28, 270, 10), ("J1", 80, 85, 14), ("J2", 86, 355, 14)))
(folder / "terrain.toml").write_text(f"""[material.rock]
density = 2600.0

[joint.default]
normal_stiffness = 1e10
shear_stiffness = 1e9
friction_deg = 38.0

[rock_mass]
region = {{ mesh = "terrain.asc", base = -10{simplify} }}
min_thickness = 0.3
fixed = [{{ boundary = "-z" }}]
{sets}""")
