"""Columns, arches and brick walls of the verification manual, for make.py."""
import math

from drawing import block, box, joint, material, search, write


def columns():
    for rows in (10, 20, 40):
        for deep in (1, 3, 10):
            name = f"column-{rows}" + ("" if deep == 1 else f"-{deep}-deep")
            angle = math.degrees(math.atan(0.2 / (0.1 * rows)))
            what = "A column" if deep == 1 else f"{deep} columns, one behind the other, each"
            ceiling = "" if deep == 1 else """
Limit analysis gives more: joints that open as they slide make the columns lean on each other."""
            write(name, f"""
{what} of {rows} blocks 0.2 m long and 0.1 m high, on a plane that is tilted. The first one overturns as one piece at
atan(0.2 / {0.1 * rows:g}) = {angle:.3f} degrees (closed form), to be met within 0.02 degrees.{ceiling}
  talus critical-angle bench/verification/{name}.toml""",
                  material(25), joint("default", 35),
                  f"[[stack]]\ncolumns = {deep}\nrows = {rows}\nslices = 1\nblock = [0.2, 1.0, 0.1]\n")


def arch(name, comment, thickness, voussoirs=27, radius=10.0):
    inner, outer = radius - thickness / 2, radius + thickness / 2
    parts = [box("left", (-outer - 1, -inner + 1), (-1, 0), True), box("right", (inner - 1, outer + 1), (-1, 0), True)]
    for k in range(voussoirs):
        ends = [math.pi * (k + j) / voussoirs for j in (0, 1)]
        corners = [(r * math.cos(a), r * math.sin(a)) for a, r in
                   ((ends[0], inner), (ends[0], outer), (ends[1], outer), (ends[1], inner))]
        parts.append(block(f"v{k + 1}", corners))
    write(name, comment, search(), material(25), joint("default", 35), *parts)


def arches():
    head = """
Semicircular arch, radius of its centre line 10 m, 27 voussoirs with straight faces, thickness {0} m, friction angle 35
degrees. It stands by itself from a thickness of 1.067 m (J. Heyman's problem, for straight voussoirs; by limit analysis,
which is exact for hinges)"""
    for thickness, angle in ((1.1, 0.70), (1.5, 8.27)):
        name = f"arch-27-{thickness}m"
        arch(name, head.format(thickness) + f""", and on a plane that is tilted to {angle:.2f} degrees, to be met within
0.05 degrees.
  talus critical-angle bench/verification/{name}.toml""", thickness)
    name = "arch-27-1.05m"
    arch(name, head.format(1.05) + f""": this one falls.
  talus critical-angle bench/verification/{name}.toml          (unstable_at_start)""", 1.05)


def brick_walls():
    for number_of, courses, load in ((1, 6, 0.6429), (2, 10, 0.5800)):
        name = f"brick-wall-{number_of}"
        parts = [box("floor", (-1, 3), (-0.5, 0), True)]
        for course in range(courses):
            z = (0.175 * course, 0.175 * (course + 1))
            edges = [0.0, 0.2, 0.6, 1.0, 1.4, 1.8, 2.0] if course % 2 == 0 else [0.0, 0.4, 0.8, 1.2, 1.6, 2.0]
            parts += [box(f"c{course + 1}b{k + 1}", (edges[k], edges[k + 1]), z) for k in range(len(edges) - 1)]
        write(name, f"""
Brick wall {number_of} of M. C. Ferris and F. Tin-Loi (Limit analysis of frictional block assemblies as a mathematical program
with complementarity constraints, 2001): {courses} courses of bricks 0.4 x 0.175 m, tan(phi) 0.65, under a horizontal load.
Load over weight by associated limit analysis {load:.4f}; no answer may be above, nor more than 5 % below.
  talus limit-analysis bench/verification/{name}.toml --for horizontal""",
              material(25), joint("default", math.degrees(math.atan(0.65))), *parts)
