#!/usr/bin/env python3
"""Writes a rough hillside of N x N squares of a metre, two triangles each, as one closed mesh, and a rockfall onto it.

    bench/rock_mass/rockfall.py FOLDER N [--rocks 20] [--height 3] [--plane] [--duration 1]
    talus run FOLDER/rockfall.toml -o FOLDER/rockfall.csv --threads 1

Rocks of some 0.6 m start HEIGHT metres above the ground, side by side; N = 22, 122 and 224 are 1,000, 30,000 and 100,000
triangles. With --plane the ground is one plane as steep as the hillside.
"""
import argparse
import math
import pathlib
import random

SLOPE = 0.6  # of a metre per metre
ROUGHNESS = 0.25  # m
WAVES = 25

parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument("folder", type=pathlib.Path, metavar="FOLDER")
parser.add_argument("squares", type=int, metavar="N")
parser.add_argument("--rocks", type=int, default=20)
parser.add_argument("--height", type=float, default=3.0, help="of the rocks above the ground [m]")
parser.add_argument("--duration", type=float, default=1.0, help="[s]")
parser.add_argument("--plane", action="store_true", help="a plane instead of the mesh")
arguments = parser.parse_args()
n = arguments.squares
arguments.folder.mkdir(parents=True, exist_ok=True)
dice = random.Random(5)
waves = [(dice.uniform(0.3, 2), dice.uniform(0, 2 * math.pi), dice.uniform(0, 2 * math.pi)) for _ in range(WAVES)]


def height(x, y):
    rough = sum(math.cos(k * (x * math.cos(a) + y * math.sin(a)) + phase) for k, a, phase in waves)
    return SLOPE * x + (0 if arguments.plane else ROUGHNESS * rough / math.sqrt(WAVES))


def mesh():
    """Ground, four sides, and a base of which each triangle has one side at the rim."""
    def at(i, j):
        return j * (n + 1) + i + 1

    vertices = [(i, j, height(i, j)) for j in range(n + 1) for i in range(n + 1)]
    faces = []
    for j in range(n):
        for i in range(n):
            faces += [(at(i, j), at(i + 1, j), at(i + 1, j + 1)), (at(i, j), at(i + 1, j + 1), at(i, j + 1))]
    rim = [(i, 0) for i in range(n)] + [(n, j) for j in range(n)]
    rim += [(i, n) for i in range(n, 0, -1)] + [(0, j) for j in range(n, 0, -1)]
    base = -5.0
    first = len(vertices) + 1
    vertices += [(i, j, base) for i, j in rim]
    middle = len(vertices) + 1
    vertices.append((n / 2, n / 2, base))
    for k, (i, j) in enumerate(rim):
        next_k = (k + 1) % len(rim)
        a, b = at(i, j), at(*rim[next_k])
        faces += [(first + k, first + next_k, b), (first + k, b, a), (first + next_k, first + k, middle)]
    return vertices, faces


def rock(k):
    """Hull of nine points; in rows along y, up the slope."""
    side = max(1, math.isqrt(arguments.rocks))
    x, y = 0.5 * n + 1.5 * (k // side - side / 2), 0.5 * n + 1.5 * (k % side - side / 2)
    z = height(x, y) + arguments.height + 0.5
    points = []
    while len(points) < 9:
        p = [dice.uniform(-1, 1) for _ in range(3)]
        if 0.5 < math.hypot(*p) < 1:
            points.append([round(c + 0.4 * q, 4) for c, q in zip((x, y, z), p)])
    return points


def plane():
    """A prism whose top is the slope."""
    return [[x, y, z] for x in (0, n) for y in (0, n) for z in (-5, SLOPE * x)]


ground = f"vertices = {plane()}"
if not arguments.plane:
    vertices, faces = mesh()
    with open(arguments.folder / "ground.obj", "w") as obj:
        obj.writelines(f"v {x} {y} {z:.4f}\n" for x, y, z in vertices)
        obj.writelines(f"f {a} {b} {c}\n" for a, b, c in faces)
    ground = 'mesh = "ground.obj"'
rocks = "".join(f'\n[[block]]\nname = "rock {k + 1}"\nvertices = {rock(k)}\n' for k in range(arguments.rocks))
(arguments.folder / "rockfall.toml").write_text(f"""[material.rock]
density = 2600.0

[joint.default]
normal_stiffness = 1e9
shear_stiffness = 1e9
friction_deg = 35.0
restitution_normal = 0.3

[run]
duration_s = {arguments.duration:g}
frame_interval_s = 0.1

[[block]]
name = "ground"
{ground}
fixed = true
{rocks}""")
