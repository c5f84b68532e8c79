"""The map of failure from Python: the command line's, as arrays."""

import csv
import unittest

import numpy

import support
import talus

# A plane of 40 degrees cuts a block out of a face; it slides where friction is less.
SLOPE = """
[material.rock]
density = 2600.0
[joint.default]
normal_stiffness = 1e10
shear_stiffness = 1e10
friction_deg = 43.0
[rock_mass]
region = { profile = [[-2, -1], [12, -1], [12, 10], [5, 10], [0, 0], [-2, 0]], y = [0, 4] }
fixed = [{ boundary = "-z" }]
[[single_joint]]
point = [2.0, 0.0, 4.0]
dip_deg = 40.0
dip_direction_deg = 270.0
"""

SWEEP = """
scenario = "slope.toml"
analysis = "safety-factor"
samples = 12
[[random]]
field = "joint.default.friction_deg"
distribution = "uniform"
min = 30.0
max = 50.0
"""


class FailureMap(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = support.Folder()
        cls.files = cls.folder.__enter__()
        cls.addClassCleanup(cls.folder.cleanup)
        cls.files.write("slope.toml", SLOPE)
        cls.sweep = cls.files.write("sweep.toml", SWEEP)
        cls.out = cls.files / "out"
        talus.batch(cls.sweep, cls.out)
        cls.map = talus.failure_map(cls.sweep, cls.out, cell_size=0.5)

    def test_probabilities_are_those_of_the_rows(self):
        with open(self.out / "results.csv", encoding="utf-8") as rows:
            factors = [float(row["safety_factor"]) for row in csv.DictReader(rows)]
        failed = sum(factor <= 1 for factor in factors)
        self.assertTrue(0 < failed < 12)
        self.assertEqual((self.map.runs, self.map.failed), (12, failed))
        above = self.map.centres[:, 2] > 4 + numpy.tan(numpy.radians(40)) * (self.map.centres[:, 0] - 2)
        numpy.testing.assert_array_equal(self.map.hits, numpy.where(above, failed, 0))
        numpy.testing.assert_array_equal(self.map.probability, self.map.hits / 12)
        self.assertTrue((self.map.probability_low <= self.map.probability).all())
        self.assertTrue((self.map.probability_high >= self.map.probability).all())

    def test_volume_is_conserved(self):
        # The block is the triangle (2, 4), (5, 10) and where the plane meets z = 10, 4 m wide.
        volume = 4 * 0.5 * (2 + 6 / numpy.tan(numpy.radians(40)) - 5) * 6 * self.map.failed / 12
        self.assertAlmostEqual(self.map.expected_failing_volume_m3, volume, delta=1e-9 * volume)
        self.assertAlmostEqual((self.map.volume_per_area * self.map.areas).sum(), volume, delta=1e-9 * volume)
        self.assertEqual(self.map.volume_without_face_m3, 0)

    def test_polygons_are_the_cells(self):
        cells = len(self.map)
        for name in ("centres", "normals"):
            self.assertEqual(getattr(self.map, name).shape, (cells, 3))
        for name in ("areas", "hits", "probability", "probability_low", "probability_high", "volume_per_area"):
            self.assertEqual(getattr(self.map, name).shape, (cells,))
        self.assertEqual(len(self.map.polygons), len(self.map.polygon_cell))
        areas = numpy.zeros(cells)
        for polygon, cell in zip(self.map.polygons, self.map.polygon_cell):
            spread = numpy.cross(polygon[1:-1] - polygon[0], polygon[2:] - polygon[0]).sum(axis=0)
            self.assertGreater(spread @ self.map.normals[cell], 0)
            areas[cell] += numpy.linalg.norm(spread) / 2
        numpy.testing.assert_allclose(areas, self.map.areas, rtol=1e-12)
        self.assertAlmostEqual(areas.sum(), self.map.face_area_m2, delta=1e-9 * areas.sum())

    def test_it_is_the_map_of_the_command_line(self):
        told = support.talus("batch", self.sweep, "-o", self.out, "--map", self.files / "map.ply", "--map-cell", "0.5")["map"]
        for name in told.keys() - {"files"}:
            self.assertEqual(getattr(self.map, name), told[name], name)
        again = talus.failure_map(self.sweep, self.out, cell_size=0.5, threads=1)
        numpy.testing.assert_array_equal(again.volume_per_area, self.map.volume_per_area)
        self.assertGreater(len(talus.failure_map(self.sweep, self.out)), len(self.map))

    def test_what_cannot_be_mapped_is_refused(self):
        other = self.files.write("other.toml", SWEEP.replace("max = 50.0", "max = 49.0"))
        more = self.files.write("more.toml", SWEEP.replace("samples = 12", "samples = 14"))
        cases = (
            (lambda: talus.failure_map(other, self.out), "another sweep"),
            (lambda: talus.failure_map(more, self.out), "12 of 14 runs, allowed: a finished batch"),
            (lambda: talus.failure_map(self.sweep, self.files / "none"), "holds no batch"),
            (lambda: talus.failure_map(self.sweep, self.out, cell_size=0), "cell_size: found 0"),
            (lambda: talus.failure_map(self.sweep, self.out, cell_size=1e-4), "makes more than 1000000 cells"),
        )
        for call, words in cases:
            with self.subTest(words), self.assertRaisesRegex(talus.ScenarioError, words):
                call()


if __name__ == "__main__":
    unittest.main()
