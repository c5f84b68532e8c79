"""Analyses from Python: the same answers as the command line, to the bit, and under every name it gives them."""

import json
import pickle
import unittest

import talus
from support import ROOT, SLOPE, Folder, of_the_slope, talus as program


class Answers(unittest.TestCase):
    def setUp(self):
        self.folder = Folder()
        self.files = self.folder.__enter__()
        self.addCleanup(self.folder.cleanup)
        self.file = self.files.write("slope.toml", SLOPE)

    def test_searches_are_those_of_the_command_line(self):
        for command, function in (
            ("critical-angle", talus.critical_angle),
            ("safety-factor", talus.safety_factor),
            ("critical-acceleration", talus.critical_acceleration),
        ):
            with self.subTest(command):
                result = function(talus.load(self.file), threads=1)
                self.assertEqual(of_the_slope(result.to_dict()), of_the_slope(program(command, self.file)))
                self.assertRegex(result.state_hash, "^[0-9a-f]{16}$")
                self.assertEqual(result.status, "found")

    def test_the_contract_names_are_there(self):
        result = talus.safety_factor(talus.load(self.file), threads=1)
        self.assertGreater(result.safety_factor, 1)
        self.assertLess(result.bracket[0], result.bracket[1])
        self.assertEqual(result.failure_mode, "sliding")
        self.assertEqual(result.moving_blocks, ["c1r1s1", "c1r2s1"])
        self.assertEqual(result.provenance.threads, 1)
        with self.assertRaisesRegex(AttributeError, "it has status, safety_factor"):
            result.factor_of_safety

    def test_a_search_has_its_curve(self):
        result = talus.critical_angle(self.file, threads=1)
        self.assertEqual(result.path.shape, (len(result.to_dict()["path"]), 2))
        displacement, load = result.path.T
        self.assertEqual(displacement[0], 0)
        self.assertAlmostEqual(load[0], 15.0)
        self.assertEqual(result.to_dict()["path"][-1], {"displacement_m": displacement[-1], "load": load[-1]})
        self.assertIs(type(result["path"]), type(result.path))
        self.assertLessEqual(result.answer_interval[0], result.critical_angle_deg)
        self.assertEqual(len(result.answer_interval_reasons), 2)
        self.assertEqual(result.failure_displacement, 3e-4)
        self.assertIsInstance(result.answers_by_displacement, list)
        self.assertGreater(result.failing_volume_m3, 0)
        self.assertAlmostEqual(result.failing_mass_kg, 2700 * result.failing_volume_m3)
        self.assertEqual(result.limit_equilibrium.blocks, ["c1r1s1", "c1r2s1"])
        self.assertEqual(pickle.loads(pickle.dumps(result)).path.tolist(), result.path.tolist())
        self.assertIn("<svg", result._repr_html_())

    def test_curve_and_blocks_are_drawn(self):
        plot, picture = self.files / "plot.svg", self.files / "picture.svg"
        result = talus.safety_factor(self.file, threads=1, plot=plot, picture=picture)
        self.assertEqual((result.plot.file, result.picture.reason), (str(plot), None))
        for file in (plot, picture):
            with open(file, encoding="utf-8") as stream:
                self.assertIn("</svg>", stream.read())

    def test_an_answer_has_its_interval(self):
        result = talus.critical_angle(self.file, threads=1)
        low, high = result.answer_interval
        self.assertLessEqual(low, result.critical_angle_deg)
        self.assertGreaterEqual(high, result.critical_angle_deg)
        self.assertAlmostEqual(result.path[:, 1].max(), result.critical_angle_deg, delta=0.01)
        for other in result.answers_by_displacement:
            self.assertGreater(other.displacement, 0)
        self.assertAlmostEqual(result.failing_volume_m3, 0.004)
        self.assertAlmostEqual(result.failing_mass_kg, 10.8)
        alone = talus.critical_angle(self.file, threads=1, range=False, ceiling=False)
        self.assertEqual(alone.critical_angle_deg, result.critical_angle_deg)
        self.assertEqual(alone.answer_interval, [alone.critical_angle_deg] * 2)
        self.assertIsNone(alone.ceiling)

    def test_key_blocks_are_those_of_the_command_line(self):
        result = talus.keyblocks(self.file, threads=1)
        self.assertEqual(of_the_slope(result.to_dict()), of_the_slope(program("keyblocks", self.file)))
        self.assertEqual([block.name for block in result.blocks], ["c1r1s1", "c1r2s1", "c2r1s1", "c2r2s1"])
        first = result.moving_groups[0]
        self.assertEqual(first.mode, "slides")
        self.assertAlmostEqual(first.mass_kg, 2700 * first.volume_m3)
        self.assertEqual(len(talus.keyblocks(self.file, most=1).moving_groups), 1)
        with self.assertRaisesRegex(talus.ScenarioError, "most"):
            talus.keyblocks(self.file, most=0)

    def test_a_storm_is_that_of_the_command_line(self):
        rain = "volume = \"closed\"\nopening = 0.002\nrain = [[0, 36], [600, 36]]\ncatchment = 0.02\n"
        file = self.files.write("rain.toml", SLOPE + rain)
        table = self.files / "storm.csv"
        result = talus.storm(file, step_s=300, csv=table, threads=1)
        self.assertEqual(of_the_slope(result.to_dict()), of_the_slope(program("storm", file, "--step-s", "300")))
        self.assertEqual([point.time_s for point in result.times], [0, 300, 600])
        self.assertAlmostEqual(result.times[1].level_m, 0.05 + 1e-5 * 0.02 * 300 / 0.002)
        self.assertLess(result.least.safety_factor, result.times[0].safety_factor)
        self.assertIn("water[0].level_m", table.read_text())
        with self.assertRaisesRegex(talus.ScenarioError, "level changes"):
            talus.storm(self.file)
        for name, value in (("step_s", 0), ("step_s", -300), ("step_s", float("nan")), ("duration_s", -1)):
            with self.subTest(name=name, value=value), self.assertRaisesRegex(talus.ScenarioError, "allowed: more than 0 s"):
                talus.storm(file, **{name: value})

    def test_threads_do_not_matter(self):
        answers = {talus.critical_angle(self.file, threads=threads).state_hash for threads in (0, 1, 2)}
        self.assertEqual(len(answers), 1)

    def test_threads_that_cannot_be_had_are_refused_at_once(self):
        model = talus.load(self.file)
        sweep = self.files / "sweep.toml"
        calls = (
            lambda threads: talus.critical_angle(model, threads=threads),
            lambda threads: talus.limit_analysis(model, "tilt", threads=threads),
            lambda threads: talus.run(model, threads=threads),
            lambda threads: talus.batch(sweep, self.files / "out", threads=threads),
            lambda threads: talus.Simulation(model, threads=threads),
            lambda threads: model.validate(threads),
        )
        for call in calls:
            for threads in (-1, 1025, 100_000, 10**9, 10**30):
                with self.subTest(threads=threads), self.assertRaisesRegex(talus.ScenarioError, f"threads: found {threads}, allowed: 0"):
                    call(threads)
            with self.assertRaises(TypeError):
                call(1.5)

    def test_limit_analysis(self):
        for load in ("tilt", "factor", "horizontal"):
            with self.subTest(load):
                result = talus.limit_analysis(self.file, load, threads=1)
                beside = program("limit-analysis", self.file, "--for", load)
                self.assertEqual(of_the_slope(result.to_dict()), of_the_slope(beside))
        with self.assertRaises(talus.ScenarioError) as raised:
            talus.limit_analysis(self.file, "weight")
        self.assertEqual(raised.exception.errors[0][3:], ("load", 'found "weight", allowed: "tilt", "factor", "horizontal"'))

    def test_run_is_that_of_the_command_line(self):
        result = talus.run(self.file, self.files / "here.mcap", threads=1)
        beside = program("run", self.file, "-o", self.files / "there.mcap")
        self.assertEqual(of_the_slope(result.to_dict()), of_the_slope(beside))
        self.assertEqual(len(result.watch.c1r1s1.position_m), 3)

    def test_a_kept_failure_is_a_run(self):
        result = talus.critical_angle(self.file, keep_run=self.files / "failing.mcap", threads=1)
        self.assertGreater(result.kept_run.frames, 1)
        self.assertEqual(len(talus.open(self.files / "failing.mcap")), result.kept_run.frames)

    def test_batch(self):
        sweep = self.files.write(
            "sweep.toml",
            'scenario = "slope.toml"\nanalysis = "critical-angle"\n'
            '[[grid]]\nfield = "joint.default.friction_deg"\nvalues = [18.0, 20.0]\n',
        )
        told = []
        result = talus.batch(sweep, self.files / "out", threads=2, progress=lambda *news: told.append(news))
        self.assertEqual((result.runs, result.done, result.failed, result.interrupted), (2, 2, 0, False))
        self.assertEqual(len((self.files / "out" / "results.csv").read_text().splitlines()), 3)
        self.assertEqual(set(told[-1]), {"batch", told[-1][1], told[-1][2]})
        again = talus.batch(sweep, self.files / "out")
        self.assertEqual(again.computed, 0)

    def test_results_show_themselves_and_stay_as_they_are(self):
        result = talus.Result({"angle_deg": 1.5, "none": None, "parts": [{"name": "<a>"}]})
        self.assertEqual(result.parts[0].name, "<a>")
        self.assertIsNone(result.none)
        self.assertIn("<td", result._repr_html_())
        self.assertIn("&lt;a&gt;", result._repr_html_())
        self.assertIn("angle_deg=1.5", repr(result))
        with self.assertRaises(AttributeError):
            result.angle_deg = 2
        self.assertEqual(json.loads(json.dumps(result.to_dict())), result.to_dict())

    def test_the_papers_slope(self):
        # The first fissure of the paper, exact 7.25 degrees.
        result = talus.critical_angle(ROOT / "bench/paper/fissure-1.toml")
        self.assertAlmostEqual(result.critical_angle_deg, 7.2537, delta=0.02)


if __name__ == "__main__":
    unittest.main()
