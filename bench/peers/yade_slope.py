# The slope in Yade, polyhedra: processor time per step. Yade's own critical angle would take days (bench/peers/run says
# how long), so it is not searched. Run by `yade -n -x yade_slope.py STEPS`; the last line is one JSON object.
import json
import math
import sys
import time

from yade import polyhedra_utils

STEPS = int(sys.argv[1]) if len(sys.argv) > 1 else 20
WARM_UP = 20  # the first steps find the contacts
COLUMNS, ROWS, SLICES = 7, 5, 3
SIZE = (0.2, 0.1, 0.1)
STIFFNESS = 1e9  # Pa/m, times the volume of the overlap; softer than the paper's, so that Yade may take longer steps
OVERLAP = 1e-6  # m: without any, intersections of touching polyhedra are degenerate and contacts are lost
MASS = 2700 * SIZE[0] * SIZE[1] * SIZE[2]
TILT = math.radians(15)

material = PolyhedraMat(density=2700, young=STIFFNESS, poisson=1.0, frictionAngle=math.radians(19.5))
O.materials.append(material)


def box(low, size):
    return [[low[k] + size[k] * corner[k] for k in range(3)]
            for corner in [(i, j, k) for i in (0, 1) for j in (0, 1) for k in (0, 1)]]


def add(low, size, fixed):
    body = polyhedra_utils.polyhedra(material, v=box(low, size), fixed=fixed)
    O.bodies.append(body)


add((-1, -1, -0.5), (4, 3, 0.5), True)
for column in range(COLUMNS):
    for row in range(ROWS):
        for piece in range(SLICES):
            low = [index * (size - OVERLAP) for index, size in zip((column, piece, row), SIZE)]
            add(low[:2] + [low[2] - OVERLAP], SIZE, False)

O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Polyhedra_Aabb()], verletDist=0.005),
    InteractionLoop([Ig2_Polyhedra_Polyhedra_PolyhedraGeom()],
                    [Ip2_PolyhedraMat_PolyhedraMat_PolyhedraPhys()],
                    [Law2_PolyhedraGeom_PolyhedraPhys_Volumetric()]),
    NewtonIntegrator(damping=0.3, gravity=(-9.81 * math.sin(TILT), 0, -9.81 * math.cos(TILT))),
]
# Two faces of a block at most on springs of k A each: omega^2 = 4 k A / m, and a fifth of the limit 2 / omega.
O.dt = 0.2 * 2 / math.sqrt(4 * STIFFNESS * SIZE[0] * SIZE[1] / MASS)

O.run(WARM_UP, True)
start = time.process_time()
O.run(STEPS, True)
seconds = time.process_time() - start
print(json.dumps({"engine": "Yade", "time_step_s": O.dt, "steps": STEPS, "cpu_seconds": seconds,
                  "contacts": O.interactions.countReal()}))
