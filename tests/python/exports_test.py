"""Other programs read what `talus export` writes: VTK plays the glTF to where the run ended, assimp finds all of glTF and PLY."""

import os
import re
import shutil
import subprocess
import unittest

import numpy as np
import talus
from support import PROGRAM, SLOPE, Folder

try:
    import vtk
except ImportError:  # Debian: python3-vtk9
    vtk = None

ALL = "TALUS_NO_SKIP" in os.environ


def vtk_centres(file, time):
    """The middle of each mesh's bounds at a time, by VTK."""
    reader = vtk.vtkGLTFReader()
    reader.SetFileName(str(file))
    reader.ApplyDeformationsToGeometryOn()
    reader.SetFrameRate(1000)
    reader.UpdateInformation()
    for animation in range(reader.GetNumberOfAnimations()):
        reader.EnableAnimation(animation)
    reader.UpdateInformation()
    reader.UpdateTimeStep(time)
    blocks, centres = reader.GetOutput().NewIterator(), []
    while not blocks.IsDoneWithTraversal():
        centres.append(blocks.GetCurrentDataObject().GetCenter())
        blocks.GoToNextItem()
    return np.array(centres)


def assimp(file):
    """What assimp counts: {"Meshes": 10, ...}."""
    said = subprocess.run(["assimp", "info", str(file)], capture_output=True, text=True, check=True).stdout
    return {name: int(count) for name, count in re.findall(r"^(Nodes|Meshes|Animations|Animation Channels|Vertices|Faces):\s+(\d+)", said, re.M)}


class Exports(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = Folder()
        files = cls.folder.__enter__()
        # So steep that it slides.
        scenario = files.write("run.toml", SLOPE.replace("tilt_deg = 10.0", "tilt_deg = 30.0").replace("0.02", "0.2").replace("0.004", "0.02"))
        talus.run(talus.load(scenario), files / "run.mcap")
        cls.motion = talus.open(files / "run.mcap")
        cls.glb, cls.ply = files / "run.glb", files / "run.ply"
        subprocess.run([PROGRAM, "export", files / "run.mcap", "--gltf", cls.glb, "--ply", "last", "-o", cls.ply, "--quiet"], check=True)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    @unittest.skipIf(vtk is None and not ALL, "python3-vtk9 is not installed")
    def test_vtk_plays_the_run(self):
        free = [k for k, name in enumerate(self.motion.blocks) if name != "floor"]
        for frame in (0, len(self.motion) // 2, len(self.motion) - 1):
            centres = vtk_centres(self.glb, self.motion.times[frame])
            self.assertEqual(len(centres), len(self.motion.blocks))
            # glTF's y is up: (x, y, z) of the model is (x, z, -y) there. Bounds of a block that turns are not its own; these slide.
            wanted = self.motion.positions[frame][free] @ np.array([[1, 0, 0], [0, 0, -1], [0, 1, 0]])
            found = centres[[np.argmin(np.linalg.norm(centres - each, axis=1)) for each in wanted]]
            np.testing.assert_allclose(found, wanted, atol=2e-3)
        self.assertGreater(np.abs(self.motion.displacements[-1]).max(), 0.01)

    @unittest.skipIf(shutil.which("assimp") is None and not ALL, "assimp-utils is not installed")
    def test_assimp_finds_everything(self):
        found = assimp(self.glb)
        self.assertGreaterEqual(found["Nodes"], len(self.motion.blocks))
        self.assertEqual(found["Meshes"], 2)  # blocks of one shape share theirs: the stack's, the floor's
        self.assertEqual(found["Faces"], 2 * 12)  # triangles of boxes
        self.assertEqual(found["Animations"], 1)
        self.assertEqual(found["Animation Channels"], len(self.motion.blocks) - 1)  # the floor stands
        self.assertEqual(assimp(self.ply)["Faces"], 12 * len(self.motion.blocks))


if __name__ == "__main__":
    unittest.main()
