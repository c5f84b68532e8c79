"""Simulations by hand and runs from files, as arrays."""

import threading
import unittest

import numpy

import talus
from support import SLOPE, Folder

FALLING = """
[run]
duration_s = 0.05
frame_interval_s = 0.01
start = "unstressed"
[material.rock]
density = 2000.0
[joint.default]
normal_stiffness = 1e8
shear_stiffness = 1e8
friction_deg = 30.0
[[block]]
name = "floor"
box = { min = [-2, -2, -1], max = [2, 2, 0] }
fixed = true
[[block]]
name = "ball"
box = { min = [-0.5, -0.5, 1.0], max = [0.5, 0.5, 2.0] }
velocity = [0.25, 0.0, 0.0]
"""


class WithFiles(unittest.TestCase):
    def setUp(self):
        folder = Folder()
        self.files = folder.__enter__()
        self.addCleanup(folder.cleanup)


class Steps(WithFiles):
    def test_free_fall(self):
        simulation = talus.Simulation(self.files.write("falling.toml", FALLING))
        start = simulation.positions.copy()
        simulation.step(50)
        t = simulation.time
        self.assertEqual(simulation.steps, 50)
        self.assertAlmostEqual(t, 50 * simulation.time_step, delta=1e-12)
        numpy.testing.assert_allclose(simulation.positions[1] - start[1], [0.25 * t, 0, -9.81 * t * t / 2], atol=1e-12)
        numpy.testing.assert_allclose(simulation.velocities[1], [0.25, 0, -9.81 * t], atol=1e-12)
        numpy.testing.assert_allclose(numpy.linalg.norm(simulation.quaternions, axis=1), 1)
        self.assertAlmostEqual(simulation.kinetic_energy, 1000 * ((9.81 * t) ** 2 + 0.0625), delta=1e-6)

    def test_views_go_along_and_are_not_written(self):
        simulation = talus.Simulation(self.files.write("falling.toml", FALLING))
        views = simulation.positions, simulation.velocities, simulation.quaternions
        before = views[0].copy()
        simulation.step(20)
        self.assertLess(views[0][1, 2], before[1, 2])
        self.assertTrue(numpy.shares_memory(views[0], simulation.positions))
        self.assertTrue(numpy.shares_memory(views[2], simulation.quaternions))
        for view in views:
            with self.assertRaises(ValueError):
                view[0, 0] = 1.0
        del simulation
        self.assertEqual(views[0].shape, (2, 3))  # they keep it alive
        self.assertTrue(numpy.isfinite(views[2]).all())

    def test_the_bits_of_a_run(self):
        model = talus.load(self.files.write("slope.toml", SLOPE))
        talus.run(model, self.files / "run.mcap", threads=1)
        frames = talus.open(self.files / "run.mcap")
        simulation = talus.Simulation(model)
        for steps, state_hash, positions in zip(frames.steps, frames.state_hashes, frames.positions):
            simulation.step(int(steps) - simulation.steps)
            self.assertEqual(simulation.state_hash, state_hash)
            numpy.testing.assert_allclose(simulation.positions, positions, atol=1e-9)
        self.assertEqual(simulation.start, "equilibrium")
        simulation.step(200)  # behind the end of the run
        self.assertGreater(simulation.time, 0.02)

    def test_contacts_carry_the_weight(self):
        simulation = talus.Simulation(self.files.write("slope.toml", SLOPE))
        contacts = simulation.contacts
        n = len(contacts)
        for name, shape in {"position": (n, 3), "normal": (n, 3), "force": (n, 3), "gap": (n,), "state": (n,)}.items():
            self.assertEqual(getattr(contacts, name).shape, shape)
        self.assertEqual(simulation.blocks[0], "floor")
        on_floor = contacts.block_a == 0
        self.assertTrue((contacts.normal[on_floor] == [0, 0, 1]).all())
        # Four blocks of 0.002 m3 on a floor that is tilted by 10 degrees; the water pushes along it.
        weight = 4 * 0.002 * 2700 * 9.81
        numpy.testing.assert_allclose(contacts.normal_force[on_floor].sum(), weight * numpy.cos(numpy.radians(10)), rtol=1e-8)
        # What a spring carries is its gap times its stiffness.
        closed = contacts.normal_force > 0
        numpy.testing.assert_allclose(
            contacts.normal_force[closed], -1e9 * contacts.gap[closed] * contacts.area[closed], rtol=1e-6)
        self.assertGreater(contacts.water_force.sum(), 0)

    def test_one_thread_at_a_time(self):
        simulation = talus.Simulation(self.files.write("falling.toml", FALLING))
        refused = []
        stepping = threading.Thread(target=simulation.step, args=(20000,))
        stepping.start()
        while stepping.is_alive():
            try:
                simulation.state_hash
            except RuntimeError:
                refused.append(True)
        stepping.join()
        self.assertTrue(refused)
        self.assertEqual(simulation.steps, 20000)

    def test_a_motion_that_became_infinite(self):
        model = talus.load(self.files.write("slope.toml", SLOPE))
        model["run.time_step_s"] = 0.01
        model["run.start"] = "unstressed"
        with self.assertRaises(talus.ScenarioError) as raised:
            talus.Simulation(model).step(5000)
        self.assertEqual(raised.exception.errors[0][3], "run.time_step_s")


class Runs(WithFiles):
    def test_frames_as_arrays(self):
        file = self.files / "run.mcap"
        result = talus.run(self.files.write("falling.toml", FALLING), file, full_every=2)
        run = talus.open(file)
        self.assertEqual(run.positions.shape, (6, 2, 3))
        self.assertEqual((len(run), run.ended, run.faults), (6, "finished", []))
        self.assertEqual(run.blocks, ["floor", "ball"])
        numpy.testing.assert_allclose(run.times, numpy.arange(6) * 0.01, atol=1e-3)
        self.assertEqual(run.state_hashes[-1], result.state_hash)
        self.assertEqual(run.steps[-1], result.steps)
        numpy.testing.assert_allclose(run.velocities[:, 1, 2], -9.81 * run.times, atol=1e-5)
        numpy.testing.assert_allclose(run.masses[1], 2000)
        self.assertEqual(run.model.to_toml(), FALLING)

    def test_the_page_of_a_run(self):
        file = self.files / "run.mcap"
        talus.run(self.files.write("falling.toml", FALLING), file)
        run = talus.open(file)
        self.assertIn("<script", run.page())
        self.assertTrue(run._repr_html_().startswith("<iframe srcdoc="))
        self.assertNotIn("<script", run._repr_html_())  # inside of the frame alone

    def test_contacts_of_a_frame(self):
        file = self.files / "run.mcap"
        model = talus.load(self.files.write("slope.toml", SLOPE))
        talus.run(model, file, full_every=1)
        contacts = talus.open(file).contacts(0)
        simulation = talus.Simulation(model)
        for name in ("position", "gap", "force", "state", "block_b"):
            numpy.testing.assert_array_equal(getattr(contacts, name), getattr(simulation.contacts, name))
        with self.assertRaises(IndexError):
            talus.open(file).contacts(99)

    def test_a_run_goes_on_to_the_same_bits(self):
        model = talus.load(self.files.write("slope.toml", SLOPE))
        whole = talus.run(model, threads=1)
        seen = []

        def stop(stage, fraction, detail):
            seen.append(stage)
            if stage == "run" and fraction > 0.3:
                raise KeyboardInterrupt

        model["run.duration_s"] = 2.0
        model["run.frame_interval_s"] = 0.1
        whole = talus.run(model, threads=1)
        with self.assertRaises(KeyboardInterrupt):
            talus.run(model, self.files / "part.mcap", threads=1, progress=stop)
        self.assertEqual(talus.open(self.files / "part.mcap").ended, "interrupted")
        resumed = talus.run(resume=self.files / "part.mcap", threads=1)
        self.assertEqual(resumed.state_hash, whole.state_hash)
        with self.assertRaises(TypeError):
            talus.run(model, resume=self.files / "part.mcap")


if __name__ == "__main__":
    unittest.main()
