#!/usr/bin/env python3
"""Writes the scenarios of this folder whose blocks come from a drawing: sections in x and z, slices 1 m thick.

    bench/verification/make.py [FOLDER]        (default: this folder)

Each function is one figure of the literature. A section is a list of corners (x, z) in either sense of rotation.
"""
import math
import pathlib

from drawing import FOLDER, between, block, box, clip, joint, material, number, point, rad, write
from masonry import arches, brick_walls, columns


# --- toppling ----------------------------------------------------------------------------------------------------------

def goodman_bray():
    heights = [4 * k for k in range(1, 11)] + [34, 28, 22, 16, 10, 4]
    for friction, factor, udec in ((38.15, 1.000, None), (38.6598, 1.0185, 1.01)):
        name = f"goodman-bray-slice-{friction:g}"
        parts = []
        for k, height in enumerate(heights):
            x = (10.0 * k, 10.0 * (k + 1))
            parts += [box(f"n{k + 1}", x, (k, k + height)), box(f"base{k + 1}", x, (-10, k), True)]
        beside = f"; UDEC {udec}" if udec else ""
        write(name, f"""
Toppling slope of 16 blocks (R. E. Goodman and J. W. Bray, 1976) as goodman-bray.toml, a slice 1 m thick with the stiffness of
published distinct-element runs, friction angle {friction:g} degrees. Factor of safety with limiting friction on every side
{factor:.4f}{beside}; to be met within 1 %, or the range is stated.
  talus safety-factor bench/verification/{name}.toml""",
              "[gravity]\ntilt_deg = 30.0\n", material(25), joint("default", friction), *parts)


def goodman_bray_held():
    """The same slope with a force on its toe block that holds it: H. Hoek and J. W. Bray's cable of 2013 kN/m."""
    force = 2013e3
    for friction, factor, udec in ((38.6598, 1.2308, 1.22), (33.0239, 1.0000, 0.99)):
        name = f"goodman-bray-slice-{friction:g}-held"
        text = body("goodman-bray-slice-38.6598").replace("friction_deg = 38.6598", f"friction_deg = {friction:g}")
        write(name, f"""
Toppling slope of 16 blocks as goodman-bray-slice-38.6598.toml with a friction angle of {friction:g} degrees, its toe block held by a
level force of 2013 kN per metre of slope at its upper outer corner. Factor of safety with limiting friction on every side
{factor:.4f}; UDEC {udec}; to be met within 1 %, or the range is stated.
  talus safety-factor bench/verification/{name}.toml""",
              text, f'[[load]]\nblock = "n1"\npoint = [0.0, 0.5, 4.0]\n'
              f"force = {point(force * math.cos(rad(30)), 0, -force * math.sin(rad(30)))}   # level, into the slope\n")


def alejano_alonso():
    """Columns above a base joint, numbered from the toe; the base is two fixed convex pieces."""
    toe, top = (20.0, 10.0), (2.9393, 19.85)
    section = [toe, (14.0, 19.85), top]
    normal = (math.sin(rad(64)), -math.cos(rad(64)))
    along = [normal[0] * x + normal[1] * z for x, z in section]
    parts = [block("rock", [(0, 0), (30, 0), (30, 10), (0, 10)], True),
             block("base", [(0, 10), toe, top, (0, 19.85)], True)]
    first, last = along[0], min(along)
    for k in range(math.ceil((first - last) / 1.6)):
        column = clip(section, normal, first - 1.6 * k)
        column = clip(column, (-normal[0], -normal[1]), -(first - 1.6 * (k + 1)))
        if len(column) > 2:
            parts.append(block(f"n{k + 1}", column))
    write("alejano-alonso", """
Toppling slope of L. R. Alejano and E. Alonso (2005): columns 1.6 m wide that dip 64 degrees into the slope, on a stepless
base, friction angle 31 degrees. Factor of safety by Goodman and Bray 0.773 (in the paper 0.76), by another limit-equilibrium
code 0.783, by finite elements (RS2) 0.86, by UDEC 0.87: to lie between 0.77 and the ceiling of limit analysis.
  talus safety-factor bench/verification/alejano-alonso.toml""", material(25), joint("default", 31), *parts)


def barla_table():
    heights = [1, 3, 5, 7] + [9] * 10
    write("barla-table", """
Tilting table of G. Barla and others: blocks of 9 cm, 14 columns against a backstop, friction angle 38 degrees. Experiment 9
degrees; RS2 9, UDEC 11 and 10.24, Goodman and Bray 7.6: to lie between 9 and 10.3 degrees.
  talus critical-angle bench/verification/barla-table.toml""",
          material(28), joint("default", 38, 5e9, 5e8),
          "[[stack]]\norigin = [0.09, 0.0, 0.09]\ncolumns = 14\nrows = 9\nslices = 1\nblock = [0.09, 1.0, 0.09]\n"
          f"heights = {heights}\n",
          box("backstop", (1.35, 1.44), (0.09, 0.9), True))


# --- slabs -------------------------------------------------------------------------------------------------------------

def slab(name, comment, face, bedding, toe_joint, release):
    """The first slab of a face 25 m high through the origin: its toe, below the release, and the rest of it. The two pieces of
    the fixed rock run into each other, so that neither has a corner at the other's face."""
    up = (-math.cos(rad(face)), math.sin(rad(face)))
    reach = (25 - toe_joint[1]) / up[1]
    back = (toe_joint[0] + reach * up[0], 25.0)
    deeper = (toe_joint[0] - 3 * up[0], toe_joint[1] - 3 * up[1])
    parts = [material(25), joint("default", bedding), joint("release", 20),
             block("toe", [(0, 0), toe_joint, release[1], release[0]]),
             block("slab", [release[0], release[1], back, (25 / up[1] * up[0], 25.0)]),
             block("rock", [deeper, back, (back[0] - 4, 25.0), (deeper[0] - 4, deeper[1])], True),
             block("foot", [(0, 0), (2 * toe_joint[0], 2 * toe_joint[1]), (0, -3), (3, -3), (3, 0)], True),
             between("toe", "slab", "release"), between("toe", "foot", "release")]
    write(name, comment, *parts)


def slabs():
    head = """
Slab failure of a face 25 m high at {0} degrees (L. R. Alejano and others, 2011): bedding parallel to it every 1.5 m with a
friction angle of {1} degrees, the first slab cut by two joints of 20 degrees. """
    slab("alejano-slab-50", head.format(50, 30) + """Associated limit analysis 1.2148, UDEC 1.21:
to lie between 1.20 and 1.2148.
  talus safety-factor bench/verification/alejano-slab-50.toml""", 50, 30, (-1.14907, -0.964181),
         ((-2.436253, 2.903412), (-2.62114, 0.790165)))
    slab("alejano-slab-55", head.format(55, 25) + """Factor of safety 1.0002, UDEC 1.00: to be
met within 0.5 %.
  talus safety-factor bench/verification/alejano-slab-55.toml""", 55, 25, (-1.22852, -0.860663),
         ((-2.22963, 3.18425), (-2.42975, 0.854877)))


def bilinear_slab():
    face, cut, foot = (-6.763195, 8.060062), (-9.061328, 6.131700), (-1.4649, 1.74595)
    up = (-math.cos(rad(50)), math.sin(rad(50)))
    crest = 50.0
    reach = (crest - cut[1]) / up[1]
    back = (cut[0] + reach * up[0], crest)
    deeper = (cut[0] - 3 * up[0], cut[1] - 3 * up[1])  # the fixed pieces run into each other, as above
    behind = (cut[0] + (cut[0] - foot[0]) / 2, cut[1] + (cut[1] - foot[1]) / 2)
    write("bilinear-slab", """
Bilinear slab: bedding at 50 degrees every 3 m with a friction angle of 30 degrees, the first slab cut and let out by joints
of 40 degrees. UDEC 1.03: to lie between 1.01 and 1.05.
  talus safety-factor bench/verification/bilinear-slab.toml""",
          material(25), joint("default", 30), joint("release", 40),
          block("toe", [face, cut, foot]),
          block("slab", [face, cut, back, (-41.9549, crest)]),
          block("rock", [deeper, back, (back[0] - 10, crest), (deeper[0] - 10, deeper[1])], True),
          block("foot", [foot, behind, (behind[0], -10), (foot[0], -10)], True),
          between("toe", "slab", "release"), between("toe", "foot", "release"))


def parallel_slabs():
    face = [(17.0, 8.2), (19.3571, 11.0095), (21.7143, 13.819), (26.9, 20.0)]
    tops = [(33.2, 20.0), (31.7, 20.0), (30.2, 20.0)]
    write("parallel-slabs", """
Three parallel slabs on planes of 36.1 degrees below a face of 50 degrees, cohesion 1 kPa, friction angle 35 degrees, 19.62
kN/m3. Factor of safety 1.008, UDEC 1.01: to be met within 0.5 %.
  talus safety-factor bench/verification/parallel-slabs.toml""",
          material(19.62), joint("default", 35, cohesion=1000),
          block("low", [face[0], face[1], tops[1], tops[0]]),
          block("middle", [face[1], face[2], tops[2], tops[1]]),
          block("high", [face[2], face[3], tops[2]]),
          block("rock", [face[0], tops[0], (40, 20), (40, 0), (17, 0)], True))


# --- rock bridges -----------------------------------------------------------------------------------------------------------

def trace(name, start, end, joint=None):
    """A joint as far as a section shows it, through the whole slice."""
    corners = [(start[0], 0, start[1]), (end[0], 0, end[1]), (end[0], 1, end[1]), (start[0], 1, start[1])]
    strength = f'joint = "{joint}"\n' if joint else ""
    return (f'[[single_joint]]\nname = "{name}"\n{strength}polygon = ['
            + ", ".join(point(*p) for p in corners) + "]\n")


def bridged(outline, rock="intact"):
    return ("[rock_mass]\nregion = { y = [0.0, 1.0], profile = [" + ", ".join(point(*p) for p in outline) + "] }\n"
            f'bridge = "{rock}"                # what the traces below do not reach\n'
            'fixed = [{ boundary = "-z" }]\n')


def intact(friction, cohesion=0.0, tension=0.0):
    text = joint("intact", friction, cohesion=cohesion)
    return text + (f"tensile_strength = {number(tension)}\n" if tension else "")


def rock_bridges():
    write("bridges-stepped", """
Three joints one above the other, each ending in the rock, below the face of parallel-slabs.toml: friction angle 35 degrees and 1 kPa;
intact rock between them, and upright from the end of each to the next and to the ground, 25 degrees and 25 kPa without tension. UDEC 1.29, finite
elements (RS2) 1.24, limit equilibrium 1.213: to lie between 1.20 and 1.29.
  talus safety-factor bench/verification/bridges-stepped.toml""",
          material(19.62), joint("default", 35, cohesion=1000), intact(25, 25000),
          bridged([(17, 8.2), (26.9, 20), (40, 20), (40, 0), (17, 0)]),
          trace("low", (18.33, 9.37), (22.33, 12.25)), trace("middle", (22.33, 13.5), (26.26, 16)),
          trace("high", (26.26, 17.16), (29.33, 19.33)),
          trace("lower step", (22.33, 12.25), (22.33, 13.5), "intact"),
          trace("upper step", (26.26, 16), (26.26, 17.16), "intact"),
          trace("crest", (29.33, 19.33), (29.33, 20), "intact"))
    for name, tension, factor, what in (("bridge-in-tension", 200e3, 1.591, "tensile strength 200 kPa, reduced like the friction"),
                                        ("bridge-broken", 0.0, 1.551, "no tensile strength")):
        write(name, f"""
A face 50 m high, a joint that daylights in it and one that comes down from the crest and ends 1.4 m above it: friction angle 40 degrees,
27 kN/m3. The bridge between their ends: {what}; the rock beyond them does not break. Limit equilibrium: factor of safety
{factor}, to be met within 0.5 %.
  talus safety-factor bench/verification/{name}.toml""",
              "[analysis]\nreduce_tensile_strength = true\n" if tension else "",
              material(27), joint("default", 40),
              intact(40, tension=tension) + ("softening_displacement = 1.0         # m: counted to the end\n" if tension else ""),
              joint("rock", 40, cohesion=1e8) + "tensile_strength = 1e8\n",
              bridged([(30, 20), (60, 70), (100, 70), (100, 0), (30, 0)], "rock"),
              trace("lower", (39.0149, 35.0248), (63, 48)), trace("upper", (62, 49), (76, 70)),
              trace("bridge", (63, 48), (62, 49), "intact"))


# --- other laws of strength ----------------------------------------------------------------------------------------------

def law(name, text):
    """A joint of another law than Coulomb's."""
    return f"[joint.{name}]\nnormal_stiffness = 1e+11\nshear_stiffness = 1e+11\n{text}\n"


def plane_blocks():
    """A flat block, 10 x 1 x 1 m, on a plane that dips 35 degrees towards -x: the stress under it is nearly the same all over."""
    dip, stress = rad(35), 26000 * math.cos(rad(35))
    joints = {
        "barton-bandis": ('law = "barton-bandis"\njrc = 10.0\njcs = 5e+7\nresidual_friction_deg = 28.0',
                          stress * math.tan(rad(28 + 10 * math.log10(5e7 / stress))),
                          "tan(phi_r + JRC log10(JCS / sigma_n)) / tan(dip), phi_r 28 degrees, JRC 10, JCS 50 MPa"),
        "power": ('law = "power"\na = 1.2\nb = 0.95', 1.2 * stress ** 0.95,
                  "1.2 sigma_n^0.95 / (sigma_n tan(dip))"),
        "envelope": ('law = "envelope"\nshear_strength = [[0.0, 4000.0], [10000.0, 12000.0], [60000.0, 40000.0]]',
                     12000 + 28000 / 50000 * (stress - 10000),
                     "strength over sigma_n tan(dip), of an envelope through (0, 4), (10, 12) and (60, 40) kPa"),
    }
    for name, (text, strength, formula) in joints.items():
        write(f"plane-{name}", f"""
A block of 10 x 1 x 1 m, 26 kN/m3, on a plane that dips 35 degrees: sigma_n = {stress / 1000:.3f} kPa. Factor of safety
{formula}
= {strength / (stress * math.tan(dip)):.4f}, to be met within 0.5 %.
  talus safety-factor bench/verification/plane-{name}.toml""",
              "[gravity]\ntilt_deg = 35.0\n", material(26), law("default", text),
              box("floor", (-5, 15), (-1, 0), True), box("block", (0, 10), (0, 1)))


# --- large slopes ------------------------------------------------------------------------------------------------------

def joint_set(name, dip, towards, spacing, origin):
    return (f'[[joint_set]]\nname = "{name}"\ndip_deg = {number(dip)}\ndip_direction_deg = {number(towards)}\n'
            f"spacing = {number(spacing)}\norigin = {point(*origin)}\n")


def large_slopes():
    outline = [(0, 0), (700, 0), (700, 140), (560, 140), (377.785587, 400), (0, 400)]
    region = ("[rock_mass]\nregion = { y = [0.0, 1.0], profile = [" + ", ".join(point(*p) for p in outline) + "] }\n"
              'fixed = [{ boundary = "-z" }, { boundary = "-x" }, { boundary = "+x" }]\n')
    east, west = 90, 270
    write("forward-toppling", """
Forward toppling of a slope 260 m high (L. Lorig and P. Varona, 2000): columns 20 m wide that dip 70 degrees into it, cross
joints every 30 m that dip 20 degrees out of it, friction angle 40 degrees. UDEC 1.13 and 1.115: to lie between 1.10 and 1.16.
  talus safety-factor bench/verification/forward-toppling.toml""", material(26.0946), joint("default", 40), region,
          joint_set("columns", 70, west, 20, (0, 0, 0)), joint_set("cross", 20, east, 30, (0, 0, 0)))
    write("backward-toppling", """
Backward toppling of a slope 260 m high (L. Lorig and P. Varona, 2000): slabs 10 m thick that dip 55 degrees with the face,
level joints every 40 m, friction angle 40 degrees. UDEC 1.70 and 1.80: to lie between 1.65 and 1.85.
  talus safety-factor bench/verification/backward-toppling.toml""", material(26.1), joint("default", 40), region,
          joint_set("slabs", 55, east, 10, (560, 0, 140)), joint_set("level", 0, 0, 40, (0, 0, 400)))


# --- a wedge in space --------------------------------------------------------------------------------------------------

def upward(dip, direction):
    return (math.sin(rad(dip)) * math.sin(rad(direction)), math.sin(rad(dip)) * math.cos(rad(direction)),
            math.cos(rad(dip)))


def solve(planes):
    """Where three planes n . x = d meet (Cramer's rule)."""
    def cross(a, b):
        return tuple(a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3] for k in range(3))
    (n1, d1), (n2, d2), (n3, d3) = planes
    volume = sum(a * b for a, b in zip(n1, cross(n2, n3)))
    return tuple((d1 * a + d2 * b + d3 * c) / volume
                 for a, b, c in zip(cross(n2, n3), cross(n3, n1), cross(n1, n2)))


def wedge():
    a, b, face, top = ((upward(*p), 0.0) for p in ((45, 105), (70, 235), (65, 185), (12, 195)))
    height = 40.0
    unit = solve((a, b, (top[0], 1.0)))
    top = (top[0], height / unit[2])
    toe, end = solve((a, b, face)), solve((a, b, top))
    corner_a, corner_b = solve((a, face, top)), solve((b, face, top))

    def hull(name, corners, fixed=False):
        rows = ",\n    ".join(point(*p) for p in corners)
        return f'[[block]]\nname = "{name}"\nvertices = [\n    {rows},\n]\n' + ("fixed = true\n" if fixed else "")

    def below(name, corners, normal, thickness=10.0):
        lower = [tuple(p - thickness * n for p, n in zip(corner, normal)) for corner in corners]
        return hull(name, corners + lower, True)

    write("wedge-hoek-bray", """
A wedge 40 m high on the planes 45/105 and 70/235 (dip/dip direction) below a face 65/185 and an upper face 12/195, friction
angle 35 degrees, dry. Factor of safety 1.7407 (E. Hoek and J. W. Bray's wedge), to be met within 0.5 %. It is for normal
forces alone across the line of intersection; so joints are soft in shear here, as in wedge-phi-35.toml.
  talus safety-factor bench/verification/wedge-hoek-bray.toml""",
          material(25), joint("default", 35, 1e11, 1e9), hull("wedge", [toe, end, corner_a, corner_b]),
          below("plane_a", [toe, end, corner_a], a[0]), below("plane_b", [toe, end, corner_b], b[0]))


# --- plane failure -------------------------------------------------------------------------------------------------------

def high_slope():
    height, crack, depth = 60.0, 14.0, 5.0
    crest, foot = height / math.tan(rad(60)), (height - crack) / math.tan(rad(35))
    profile = [(0, -10), (foot + 30, -10), (foot + 30, height), (crest, height), (0, 0)]
    corners = [(foot, 0, height - crack), (foot, 1, height - crack), (foot, 1, height), (foot, 0, height)]
    strength = "friction_deg = 37.0\ncohesion = 25e3\nresidual_cohesion = 25e3   # as limit equilibrium has it"
    write("hoek-bray-60m", f"""
Plane failure of a slope 60 m high (E. Hoek and J. W. Bray, Rock slope engineering): face 60 degrees, plane 35 degrees, a crack
14 m deep with 5 m of water, cohesion 25 kPa, friction angle 37 degrees, 26 kN/m3. A slice 1 m thick. Limit equilibrium,
[C A + (W cos p - U - V sin p) tan phi] / (W sin p + V cos p): factor of safety 1.0935, to be met within 1 %.
  talus safety-factor bench/verification/hoek-bray-60m.toml""",
          material(26),
          f"[joint.plane]\nnormal_stiffness = 1e+10\nshear_stiffness = 1e+10\n{strength}\n",
          "[joint.default]                 # the crack\nnormal_stiffness = 1e+10\nshear_stiffness = 1e+10\nfriction_deg = 0.0\n",
          "[rock_mass]\nregion = { y = [0.0, 1.0], profile = [" + ", ".join(point(*p) for p in profile) + "] }\n"
          "names = { slide = [30.0, 0.5, 30.0], base = [50.0, 0.5, 0.0], back = [80.0, 0.5, 58.0] }\n"
          'fixed = [{ name = "base" }, { name = "back" }]\n',
          '[[single_joint]]\nname = "plane"\npoint = [0.0, 0.0, 0.0]\ndip_deg = 35\ndip_direction_deg = 270\n',
          '[[single_joint]]\nname = "crack"\npolygon = [' + ", ".join(point(*p) for p in corners) + "]\n",
          f'[[water]]                       # thrust in the crack\njoint = "crack"\ndepth = {depth}\n',
          "[[water]]                       # uplift on the plane: full head at the crack, none at the toe\n"
          f'between = ["slide", "base"]\nhead = [{depth}, 0.0]\n')


def sau_mau_ping():
    """Without a crack; water by a distribution of Hoek and Bray, an earthquake by its coefficient."""
    height, back = 60.0, 60.0 / math.tan(rad(35))
    profile = [(0, -5), (back + 60, -5), (back + 60, height), (height / math.tan(rad(50)), height), (0, 0)]
    for water, shaken, factor in ((False, 0, 1.6494), (True, 0, 0.9803), (False, 0.08, 1.43), (True, 0.08, 0.8295)):
        name = f"sau-mau-ping-{'wet' if water else 'dry'}" + ("-shaken" if shaken else "")
        what = "full of water, the pressure greatest at half height" if water else "dry"
        write(name, f"""
Plane failure of the slope of Sau Mau Ping without a crack (E. Hoek and J. W. Bray, Rock slope engineering): 60 m high, face 50
degrees, plane 35 degrees, cohesion 100 kPa, friction angle 35 degrees, 2,700 kg/m3; {what}{f", k_h {shaken}" if shaken else ""}.
A slice 1 m thick. Limit equilibrium, [C A + (W (cos p - k sin p) - U) tan phi] / [W (sin p + k cos p)]: factor of safety
{factor:.4f}, to be met within 0.3 %.
  talus safety-factor bench/verification/{name}.toml""",
              "[material.rock]\ndensity = 2700.0\n",
              joint("default", 0, 1e10, 1e10), joint("plane", 35, 1e10, 1e10, 100e3),
              "[rock_mass]\nregion = { y = [0.0, 1.0], profile = [" + ", ".join(point(*p) for p in profile) + "] }\n"
              'fixed = [{ boundary = "-z" }, { boundary = "+x" }]\n',
              '[[single_joint]]\nname = "plane"\npoint = [0.0, 0.0, 0.0]\ndip_deg = 35\ndip_direction_deg = 270\n',
              f"[seismic]\nhorizontal = {shaken}\n" if shaken else "",
              '[[water]]\njoint = "plane"\npercent_filled = 100.0\npeak = "half-height"\n' if water else "")


def daylighting():
    crack, foot = 10.928203230, 7.652010281
    corners = [(0, 0, 0), (0, 1, 0), (crack, 1, foot), (crack, 0, foot)]
    head, rest = body("hoek-bray-crack-2m").split("[rock_mass]\n")
    region = rest[:rest.index("names = ")]
    write("hoek-bray-crack-2m-daylight", """
Plane failure with a tension crack as hoek-bray-crack-2m.toml, the water of the plane given with its joint, which ends at the
crack: full there, falling to nothing in a straight line to where it daylights at the toe. Limit equilibrium: factor of safety
1.363.
  talus safety-factor bench/verification/hoek-bray-crack-2m-daylight.toml""",
          head + "[rock_mass]\n" + region +
          "names = { slide = [6.0, 0.5, 6.0], base = [6.0, 0.5, -2.0], back = [15.0, 0.5, 6.0] }\n"
          'fixed = [{ name = "base" }, { name = "back" }]\n',
          f'[[single_joint]]\nname = "crack"\npoint = {point(crack, 0, 0)}\ndip_deg = 90\ndip_direction_deg = 270\n',
          '[[single_joint]]                # in front of the crack\nname = "plane"\npolygon = [' +
          ", ".join(point(*p) for p in corners) + "]\n",
          f'[[water]]                       # thrust in the crack\njoint = "crack"\nelevation = {number(foot + 2)}\n'
          f"base = {number(foot)}\n",
          '[[water]]                       # uplift on the plane, at its upper and its lower end\njoint = "plane"\n'
          "head = [2.0, 0.0]\n")


def short_cable():
    write("pull-out-cable-short", """
Pull on a grouted cable as pull-out-cable.toml, bonded over 2 m only. Initial stiffness sqrt(E A k_b) tanh(L sqrt(k_b / (E A)))
= 44.7 MN/m, to be met within 1 %; then the grout gives way at 2 m x 0.175 MN/m = 0.35 MN.
  talus run bench/verification/pull-out-cable-short.toml -o pull.csv""",
          body("pull-out-cable").replace("end = [0.0, 0.0, -17.7]", "end = [0.0, 0.0, -2.0]"))


# --- earthquakes ---------------------------------------------------------------------------------------------------------

def body(name):
    """A scenario without the comment at its head."""
    text = (FOLDER / f"{name}.toml").read_text()
    return text[text.index("\n\n") + 2:]


def trend(a, b):
    """Clockwise from north: where the line of intersection of two planes (dip, dip direction) goes down [deg]."""
    n, m = upward(*a), upward(*b)
    x, y, z = (n[(k + 1) % 3] * m[(k + 2) % 3] - n[(k + 2) % 3] * m[(k + 1) % 3] for k in range(3))
    return math.degrees(math.atan2(-x, -y) if z > 0 else math.atan2(x, y)) % 360


def earthquakes():
    for depth, factor, critical in ((0, 1.332, 0.2496), (2, 1.173, 0.1703)):
        name = f"hoek-bray-crack-{depth}m-shaken"
        write(name, f"""
Plane failure with a tension crack as hoek-bray-crack-{depth}m.toml, with a horizontal pseudo-static coefficient of 0.08 towards the
face. Limit equilibrium: factor of safety {factor:g}, critical coefficient {critical:g}; to be met within 1 %.
  talus safety-factor bench/verification/{name}.toml
  talus critical-acceleration bench/verification/{name}.toml""",
              "[seismic]\nhorizontal = 0.08\n", body(f"hoek-bray-crack-{depth}m"))
    down = trend((40, 130), (60, 220))
    for coefficient, factor in ((0.05, 1.150), (0.1, 1.041), (0.2, 0.856)):
        name = f"wedge-phi-40-shaken-{coefficient:g}"
        write(name, f"""
A wedge on two planes as wedge-phi-40.toml, with a horizontal pseudo-static coefficient of {coefficient:g} along the trend of the line
of intersection. Wedge formula of limit equilibrium: factor of safety {factor:g}; to be met within 1 %.
  talus safety-factor bench/verification/{name}.toml""",
              f"[seismic]\nhorizontal = {coefficient:g}\ndirection_deg = {number(down)}\n", body("wedge-phi-40"))


def rock_slopes():
    """bench/examples/rock-slope.toml with other spacings, and the same slope between sets whose spacing and orientation scatter."""
    example = (pathlib.Path(__file__).parents[1] / "examples" / "rock-slope.toml").read_text()
    body = example[example.index("[material.limestone]"):]
    for blocks, share in ((148, 1.45), (842, 0.68)):
        name = f"rock-slope-{blocks}"
        text = body
        for spacing, after in (("2.0", "\norigin = [0.0, 0.0"), ("2.4", ""), ("2.0", "\norigin = [0.0, 1.3")):
            text = text.replace(f"spacing = {spacing}{after}", f"spacing = {number(float(spacing) * share)}{after}", 1)
        text = text.replace("min_thickness = 0.1 ", f"min_thickness = {number(0.1 * min(1, share))} ")
        write(name, f"""
The slope of bench/examples/rock-slope.toml between joints {share:g} times as far apart: {blocks} blocks.
  talus safety-factor bench/verification/{name}.toml""", text)
    region = body[body.index("region ="):body.index("min_thickness")]
    fixed = body[body.index("fixed ="):body.index("names =")]
    for blocks, share in ((225, 1.55), (513, 1.1)):
        name = f"random-slope-{blocks}"
        sets = "".join(f"""
[[joint_set]]
name = "{set_name}"
dip_deg = {dip}
dip_direction_deg = {direction}
spacing = {number(spacing * share)}
spacing_law = "exponential"
fisher = 50
""" for set_name, dip, direction, spacing in (("a", 28, 270, 1.9), ("b", 80, 85, 2.2), ("c", 87, 355, 1.9)))
        write(name, f"""
The slope of bench/examples/rock-slope.toml between three sets with exponential spacing whose orientations scatter (fisher 50):
{blocks} blocks.
  talus safety-factor bench/verification/{name}.toml""", f"""[material.rock]
density = 2600.0

{joint("default", 40.0, 1e10, 1e9)}
[rock_mass]
{region}min_thickness = 0.05            # m
{fixed}{sets}""")


if __name__ == "__main__":
    for figure in (columns, arches, brick_walls, goodman_bray, goodman_bray_held, alejano_alonso, barla_table, slabs,
                   bilinear_slab, parallel_slabs, rock_bridges, plane_blocks, large_slopes, wedge, high_slope, sau_mau_ping, daylighting, short_cable, earthquakes,
                   rock_slopes):
        figure()
