"""Kinematic analysis from Python: the command line's answer, of a table, a file and a model."""

import unittest

import talus
from support import Folder, of_the_slope, talus as program

POLES = "dip,dip direction,set\n44,178,J1\n48,186,J1\n25,181,J1\n81,352,J2\n76,4,J2\n40,5,J2\n"
FACE = ["--slope", "70/180", "--friction", "30"]


class Kinematics(unittest.TestCase):
    def setUp(self):
        self.folder = Folder()
        self.files = self.folder.__enter__()
        self.addCleanup(self.folder.cleanup)
        self.file = self.files.write("poles.csv", POLES)

    def test_of_a_table_it_is_the_command_lines(self):
        result = talus.kinematics(self.file, slope=(70, 180), friction=30)
        self.assertEqual(of_the_slope(result.to_dict()), of_the_slope(program("kinematics", self.file, *FACE)))
        self.assertEqual((result.planar.critical, result.flexural_toppling.critical, result.wedge.total), (2, 2, 15))
        self.assertEqual([each.name for each in result.sets], ["J1", "J2"])

    def test_options_are_those_of_the_command_line(self):
        picture = self.files / "net.svg"
        result = talus.kinematics(self.file, slope=(70, 180), friction=30, lateral=10, sets=2, scanline=(180, 5), bias_limit=10,
                                  stereonet=picture, view="intersections", net="equal-angle")
        beside = program("kinematics", self.file, *FACE, "--lateral", "10", "--sets", "2", "--scanline", "180/5", "--bias-limit", "10")
        self.assertEqual(of_the_slope(result.to_dict()), of_the_slope(beside))
        with open(picture, encoding="utf-8") as stream:
            self.assertIn("wedge sliding", stream.read())

    def test_of_a_model(self):
        model = talus.Model()
        model.material("rock", density=2700.0)
        model.joint("default", normal_stiffness=1e10, shear_stiffness=1e10, friction_deg=30.0)
        model.rock_mass(region=dict(box=dict(min=[0, 0, 0], max=[10, 10, 10])))
        model.joint_set("J1", dip_deg=45, dip_direction_deg=180, spacing=2.0)
        result = talus.kinematics(model, slope=(70, 180), friction=30)
        self.assertEqual(result.planar.critical, result.poles)
        self.assertIsNone(result.sets[0].fisher_k)

    def test_faults(self):
        for options, field in (
            (dict(slope=(95, 180)), "slope"),
            (dict(friction=91), "friction"),
            (dict(lateral=-1), "lateral"),
            (dict(sets=7), "sets"),
            (dict(view="both"), "view"),
            (dict(net="polar"), "net"),
            (dict(contours="kamb"), "contours"),
            (dict(counting_area=0), "counting_area"),
            (dict(scanline=(0, 95)), "scanline"),
            (dict(scanline=(0, 5), bias_limit=0), "bias_limit"),
            (dict(stereonet="net.png"), "stereonet"),
        ):
            with self.subTest(field), self.assertRaises(talus.ScenarioError) as raised:
                talus.kinematics(self.file, **{"slope": (70, 180), "friction": 30, **options})
            self.assertEqual(raised.exception.errors[0][3], field)
        with self.assertRaises(talus.ScenarioError) as raised:
            talus.kinematics(self.files.write("bad.csv", "dip,dd\n95,1\n"), slope=(70, 180), friction=30)
        self.assertEqual(raised.exception.errors[0][1:3], (2, 1))


if __name__ == "__main__":
    unittest.main()
