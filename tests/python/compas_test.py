"""Assemblies of COMPAS: read in the forms of its versions 1 and 2, forces in their terms balance the blocks."""

import copy
import json
import unittest

import numpy as np
import talus
import talus.compas
from support import ROOT, Folder

HERE = ROOT / "tests/python/compas"
STIFF = dict(density=2400.0, normal_stiffness=1e10, shear_stiffness=1e10, friction_deg=35.0)


def content(thing):
    return thing.get("data", thing.get("value"))


def graph_of(assembly):
    graph = content(assembly)["graph"]
    return graph.get("data", graph)


def interfaces(assembly):
    """(u, v, interface's content) of all edges."""
    for u, others in graph_of(assembly)["edge"].items():
        for v, attributes in others.items():
            for interface in attributes["interfaces"]:
                yield u, v, content(interface)


def forces_on_v(interface):
    """Points and forces there, put together again as compas_cra does: c_np w - c_nn w + c_u u + c_v v."""
    frame = content(interface["frame"])
    u, v = np.array(frame["xaxis"]), np.array(frame["yaxis"])
    w = np.cross(u, v)
    points = np.array([content(point) for point in interface["points"]])
    return points, np.array([(f["c_np"] - f["c_nn"]) * w + f["c_u"] * u + f["c_v"] * v for f in interface["forces"]])


def wrench_on(assembly, node):
    """Sum of the forces on a node's block, and of their moments about the origin."""
    total = np.zeros(6)
    for u, v, interface in interfaces(assembly):
        if node not in (u, v):
            continue
        points, forces = forces_on_v(interface)
        sign = 1.0 if v == node else -1.0
        total += sign * np.concatenate([forces.sum(axis=0), np.cross(points, forces).sum(axis=0)])
    return total


class Compas(unittest.TestCase):
    def test_two_blocks_of_both_versions(self):
        weight = 2400.0 * 0.5 * 9.81
        for version in (1, 2):
            with self.subTest(version=version):
                assembly = talus.compas.load(HERE / f"two-blocks-{version}.json")
                model = talus.compas.model(assembly, **STIFF)
                self.assertEqual(model.blocks, ["b0", "b1"])
                self.assertAlmostEqual(talus.critical_angle(model).critical_angle_deg, 35.0, delta=0.02)
                loaded = talus.compas.with_forces(assembly, model)
                ((u, v, interface),) = interfaces(loaded)
                self.assertEqual((u, v), ("0", "1") if version == 2 else ("1", "0"))  # the assembly's own edge
                self.assertEqual(len(interface["points"]), 4)
                self.assertAlmostEqual(interface["size"], 1.0)
                for force in interface["forces"]:
                    self.assertAlmostEqual(force["c_np"], weight / 4, delta=1e-6 * weight)
                    self.assertEqual(force["c_nn"], 0.0)
                np.testing.assert_allclose(wrench_on(loaded, "1")[:3], [0, 0, weight], atol=1e-6 * weight)
                np.testing.assert_allclose(wrench_on(loaded, "0")[:3], [0, 0, -weight], atol=1e-6 * weight)

    def test_frame_goes_from_u_to_v(self):
        assembly = talus.compas.load(HERE / "two-blocks-2.json")
        ((_, _, interface),) = interfaces(talus.compas.with_forces(assembly, talus.compas.model(assembly, **STIFF)))
        frame = content(interface["frame"])
        np.testing.assert_allclose(np.cross(frame["xaxis"], frame["yaxis"]), [0, 0, 1], atol=1e-9)
        np.testing.assert_allclose(frame["point"], [0, 0, 0], atol=1e-6)

    def test_arch_is_in_balance(self):
        assembly = talus.compas.load(ROOT / "bench/examples/compas-arch.json")
        model = talus.compas.model(assembly, **STIFF)
        simulation = talus.Simulation(model)
        self.assertEqual(simulation.start, "equilibrium")
        before = copy.deepcopy(assembly)
        loaded = talus.compas.with_forces(assembly, simulation)
        self.assertEqual(assembly, before)
        self.assertEqual(len(list(interfaces(loaded))), 16)
        down = np.zeros(3)
        voussoir = 2400.0 * 9.81 * 0.5 * 0.8 * 5.0 * np.sin(np.pi / 15)  # of a straight one: area x width
        for node in map(str, range(1, 16)):
            wrench = wrench_on(loaded, node)
            np.testing.assert_allclose(wrench[:3], [0, 0, voussoir], atol=1e-6 * voussoir)
        for node in ("0", "16"):
            down += wrench_on(loaded, node)[:3]
        np.testing.assert_allclose(down, [0, 0, -15 * voussoir], atol=1e-5 * voussoir)
        with Folder() as files:
            talus.compas.save(loaded, files / "out.json")
            self.assertEqual(talus.compas.load(files / "out.json"), json.loads(json.dumps(loaded)))

    def test_faults_are_told(self):
        assembly = talus.compas.load(HERE / "two-blocks-2.json")
        dented = copy.deepcopy(assembly)
        content(graph_of(dented)["node"]["1"]["block"])["vertex"]["6"].update(x=0.1, y=0.1)
        for wrong, words in (({}, "no graph"), ({"node": {"0": {}}}, "no block"), (dented, "not convex")):
            with self.subTest(words), self.assertRaises(talus.ScenarioError) as caught:
                talus.compas.model(wrong, **STIFF)
            self.assertIn(words, caught.exception.errors[0][4])

    def test_wrong_kinds_inside_are_told(self):
        def wrong_at(value, *keys):
            """The assembly with a value in place of what is there; "block" leads into a block's mesh."""
            assembly = copy.deepcopy(talus.compas.load(HERE / "two-blocks-2.json"))
            place = graph_of(assembly)
            for key in keys[:-1]:
                place = content(place[key]) if key == "block" else place[key]
            place[keys[-1]] = value
            return assembly

        assembly = talus.compas.load(HERE / "two-blocks-2.json")
        model = talus.compas.model(assembly, **STIFF)
        for value in (3, [1], "x", None):
            for keys in (
                ["node"], ["node", "1"], ["node", "1", "block"], ["node", "1", "block", "vertex"], ["node", "1", "block", "face"],
                ["node", "1", "block", "attributes"], ["node", "1", "block", "vertex", "6"],
            ):
                with self.subTest(value=value, keys=keys), self.assertRaises(talus.ScenarioError):
                    talus.compas.model(wrong_at(value, *keys), **STIFF)
            for keys in (["node"], ["edge"], ["edge", "0"], ["edge", "0", "1"]):
                with self.subTest(value=value, keys=keys), self.assertRaises(talus.ScenarioError):
                    talus.compas.with_forces(wrong_at(value, *keys), model)
        for keys, value in ((["node", "1", "block", "vertex", "6", "x"], 10**400), (["node", "1", "block", "vertex"], {})):
            with self.subTest(keys=keys), self.assertRaises(talus.ScenarioError):
                talus.compas.model(wrong_at(value, *keys), **STIFF)
        fewer = copy.deepcopy(assembly)
        del graph_of(fewer)["node"]["1"]
        with self.assertRaisesRegex(talus.ScenarioError, "no node of the block b1"):
            talus.compas.with_forces(fewer, model)


if __name__ == "__main__":
    unittest.main()
