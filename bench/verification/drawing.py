"""Pieces of scenarios that make.py writes: sections, blocks, joints and the files themselves."""
import math
import pathlib
import sys

FOLDER = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parent)
GRAVITY = 9.81


def rad(degrees):
    return math.radians(degrees)


def number(value):
    text = f"{value:.9f}".rstrip("0").rstrip(".")
    return "0.0" if text in ("0", "-0") else text if "." in text else text + ".0"


def point(*values):
    return "[" + ", ".join(number(v) for v in values) + "]"


def clip(section, normal, limit):
    """The part of a convex section with normal . p <= limit."""
    result = []
    side = [normal[0] * x + normal[1] * z - limit for x, z in section]
    for k, p in enumerate(section):
        q, a, b = section[(k + 1) % len(section)], side[k], side[(k + 1) % len(section)]
        if a <= 0:
            result.append(p)
        if a * b < 0:
            share = a / (a - b)
            result.append((p[0] + share * (q[0] - p[0]), p[1] + share * (q[1] - p[1])))
    return result


def joint(name, friction, normal=1e11, shear=1e10, cohesion=0.0):
    lines = [f"[joint.{name}]", f"normal_stiffness = {normal:g}", f"shear_stiffness = {shear:g}",
             f"friction_deg = {number(friction)}"]
    if cohesion:
        lines += [f"cohesion = {number(cohesion)}",
                  f"residual_cohesion = {number(cohesion)}   # as limit equilibrium has it"]
    return "\n".join(lines) + "\n"


def material(unit_weight):
    return f"[material.rock]\ndensity = {number(unit_weight * 1000 / GRAVITY)}   # {unit_weight:g} kN/m3\n"


def block(name, section, fixed=False, joint=None, y=(0.0, 1.0)):
    corners = [point(x, side, z) for side in y for x, z in section]
    half = len(section)
    lines = ["[[block]]", f'name = "{name}"', "vertices = ["]
    lines += ["    " + ", ".join(corners[:half]) + ",", "    " + ", ".join(corners[half:]) + ",", "]"]
    if joint:
        lines.append(f'joint = "{joint}"')
    if fixed:
        lines.append("fixed = true")
    return "\n".join(lines) + "\n"


def box(name, x, z, fixed=False):
    return block(name, [(x[0], z[0]), (x[1], z[0]), (x[1], z[1]), (x[0], z[1])], fixed)


def between(a, b, joint):
    return f'[[interface]]\nbetween = ["{a}", "{b}"]\njoint = "{joint}"\n'


def write(name, comment, *parts):
    lines = ["# " + line if line else "#" for line in comment.strip().splitlines()]
    text = "\n".join(lines) + "\n\n" + "\n".join(part for part in parts if part)
    (FOLDER / f"{name}.toml").write_text(text)


def search(stop=45.0, start=None):
    return "[analysis]\n" + (f"start_deg = {number(start)}\n" if start is not None else "") + \
        f"stop_deg = {number(stop)}\n"
