"""Models built in code, changed by field, written and read again; what is wrong with them."""

import pathlib
import pickle
import tomllib
import unittest

import talus
from talus import _toml
from talus._model import _sections
from support import ROOT, SLOPE, Folder


def sliding_block():
    model = talus.Model()
    model.material("rock", density=2700.0)
    model.joint("default", normal_stiffness=1e9, shear_stiffness=1e9, friction_deg=20.0)
    model.block("floor", box={"min": [-5.0, -5.0, -1.0], "max": [5.0, 5.0, 0.0]}, fixed=True)
    model.block("key", box={"min": [0, 0, 0], "max": [1, 1, 0.5]})
    model.analysis(start_deg=15.0, stop_deg=25.0)
    return model


class Built(unittest.TestCase):
    def test_a_block_slides_at_its_friction_angle(self):
        for friction in (18.0, 21.5):
            model = sliding_block()
            model["joint.default.friction_deg"] = friction
            self.assertAlmostEqual(talus.critical_angle(model).critical_angle_deg, friction, delta=0.02)

    def test_every_section_of_a_file_can_be_added(self):
        model = talus.Model()
        for section, kind in _sections().items():
            model.add(section, "name", key=1)
            with self.subTest(section=section):
                one = {"key": 1}
                expected = {"list": [{"name": "name", **one}], "named": {"name": one}, "single": one}
                self.assertEqual(model._tables[section], expected[kind])
        self.assertEqual({_sections()[name] for name in ("bolt", "joint", "gravity")},
                         {"list", "named", "single"})

    def test_methods_chain_and_fields_are_read(self):
        model = talus.Model().gravity(tilt_deg=3.0).gravity(magnitude=9.8)
        self.assertEqual(model["gravity.tilt_deg"], 3.0)
        self.assertEqual(model.tables, {"gravity": {"tilt_deg": 3.0, "magnitude": 9.8}})
        del model["gravity.tilt_deg"]
        with self.assertRaises(KeyError):
            model["gravity.tilt_deg"]
        with self.assertRaises(KeyError):
            model["block[0].name"]

    def test_numpy_goes_in(self):
        import numpy

        model = sliding_block()
        model["block[1].box.max"] = numpy.array([1.0, 1.0, 0.25])
        model["joint.default.friction_deg"] = numpy.float64(19.0)
        self.assertEqual(model.blocks, ["floor", "key"])
        self.assertIn("max = [1.0, 1.0, 0.25]", model.to_toml())

    def test_copies_are_apart(self):
        model = sliding_block()
        twin = model.copy()
        twin["joint.default.friction_deg"] = 30.0
        self.assertEqual(model["joint.default.friction_deg"], 20.0)

    def test_every_scenario_survives_being_written(self):
        for file in sorted((ROOT / "bench").rglob("*.toml")):
            tables = tomllib.loads(file.read_text())
            with self.subTest(file=str(file)):
                self.assertEqual(tomllib.loads(_toml.text_of(tables)), tables)

    def test_written_and_read_again_it_is_the_same_model(self):
        with Folder() as files:
            loaded = talus.load(files.write("slope.toml", SLOPE))
            self.assertEqual(loaded.to_toml(), SLOPE)
            built = talus.Model(loaded.tables)
            built.save(files / "built.toml")
            answers = {
                talus.critical_angle(model, threads=1).state_hash for model in (loaded, built, files / "built.toml")
            }
            self.assertEqual(len(answers), 1)

    def test_meshes_lie_beside_the_scenario(self):
        model = talus.load(ROOT / "bench/examples/hillside.toml")
        model["analysis.stop_deg"] = 60.0
        self.assertGreater(len(model.blocks), 10)


class Faults(unittest.TestCase):
    def test_file_line_column_field_and_message(self):
        with Folder() as files:
            file = files.write("slope.toml", SLOPE.replace("friction_deg = 20.0", "friction_deg = 120.0"))
            with self.assertRaises(talus.ScenarioError) as raised:
                talus.load(file)
        [(where, line, column, field, message)] = raised.exception.errors
        self.assertEqual((where, line, column, field), (str(file), 16, 16, "joint.default.friction_deg"))
        self.assertIn("found 120", message)
        self.assertEqual(str(raised.exception), f"{file}:16:16: {field}: {message}")
        self.assertIsInstance(raised.exception, ValueError)
        self.assertEqual(pickle.loads(pickle.dumps(raised.exception)).errors, raised.exception.errors)

    def test_all_of_them_at_once(self):
        model = sliding_block()
        model["joint.default.cohesion"] = -1.0
        model.block("odd", boxes=1)
        with self.assertRaises(talus.ScenarioError) as raised:
            model.validate()
        self.assertGreaterEqual(len(raised.exception.errors), 2)
        self.assertEqual({error[0] for error in raised.exception.errors}, {"model"})
        # Lines are those of the text that the model stands for.
        line = next(error[1] for error in raised.exception.errors if error[3] == "joint.default.cohesion")
        self.assertEqual(model.to_toml().splitlines()[line - 1], "cohesion = -1.0")

    def test_of_the_geometry_too(self):
        model = sliding_block()
        model.block("inside", box={"min": [0.1, 0.1, 0.1], "max": [0.9, 0.9, 0.4]})
        with self.assertRaises(talus.ScenarioError):
            model.validate()

    def test_missing_files(self):
        with self.assertRaises(talus.ScenarioError):
            talus.load("/nowhere/slope.toml")
        with self.assertRaises(talus.ScenarioError):
            talus.open("/nowhere/run.mcap")

    def test_a_nul_ends_no_path(self):
        with Folder() as files:
            file = files.write("slope.toml", SLOPE)
            model, cut = talus.load(file), f"{file}\0.toml"
            for call in (
                lambda: talus.load(cut),
                lambda: talus.critical_angle(cut),
                lambda: talus.critical_angle(model, plot=files / "a.svg\0.svg"),
                lambda: talus.run(model, files / "a.mcap\0.mcap"),
                lambda: talus.run(resume=files / "a.mcap\0.mcap"),
                lambda: talus.batch(cut, files / "out"),
                lambda: talus.open(files / "a.mcap\0.mcap"),
                lambda: talus.Simulation(cut),
                lambda: talus.Model(folder=f"{files.path}\0"),
            ):
                with self.assertRaisesRegex(talus.ScenarioError, "NUL"):
                    call()
            self.assertEqual(sorted(each.name for each in files.path.iterdir()), ["slope.toml"])

    def test_a_nul_ends_no_mesh_files_name(self):
        model = talus.load(ROOT / "bench/examples/hillside.toml")
        model["rock_mass.region"] = {"obj": "hillside.obj\0.obj"}
        with self.assertRaisesRegex(talus.ScenarioError, "NUL"):
            model.validate()

    def test_a_file_system_that_refuses(self):
        with self.assertRaises(OSError):
            talus.run(sliding_block(), "/nowhere/run.mcap")

    def test_what_cannot_be_in_a_scenario(self):
        with self.assertRaises(TypeError):
            talus.Model().joint(friction_deg=1j).validate()


class Shown(unittest.TestCase):
    def test_in_a_notebook(self):
        model = sliding_block()
        self.assertIn("[joint.default]", model._repr_html_())
        self.assertIn("2 block", repr(model))
        self.assertIn("<svg", model._repr_html_())
        model["joint.default.friction_deg"] = -1.0
        self.assertIn("friction_deg", model._repr_html_())
        self.assertNotIn("<svg", model._repr_html_())

    def test_paths_of_any_kind(self):
        self.assertEqual(
            talus.load(pathlib.Path(ROOT / "bench/paper/dry.toml")).path, str(ROOT / "bench/paper/dry.toml")
        )


if __name__ == "__main__":
    unittest.main()
