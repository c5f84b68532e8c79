"""What the tests share: the program, its JSON, and small scenarios."""

import json
import os
import pathlib
import subprocess
import tempfile

PROGRAM = os.environ["TALUS_PROGRAM"]
ROOT = pathlib.Path(os.environ["TALUS_SOURCE_DIR"])

SLOPE = """
[gravity]
tilt_deg = 10.0
[analysis]
start_deg = 15.0
stop_deg = 25.0
[run]
duration_s = 0.02
frame_interval_s = 0.004
watch = ["c1r1s1"]
[material.rock]
density = 2700.0
[joint.default]
normal_stiffness = 1e9
shear_stiffness = 1e9
friction_deg = 20.0
[[stack]]
columns = 2
rows = 2
slices = 1
block = [0.2, 0.1, 0.1]
[[water]]
fissure = 1
depth = 0.05
"""

# What a result says of the machine and not of the slope.
OF_THE_CALL = ("provenance", "wall_seconds", "time_s", "results", "summary", "page", "snapshots", "output")


def talus(*arguments):
    """The JSON of the command line."""
    done = subprocess.run([PROGRAM, *map(str, arguments), "--json", "--quiet"], capture_output=True, check=False)
    return json.loads(done.stdout)


def of_the_slope(values):
    return {name: value for name, value in values.items() if name not in OF_THE_CALL}


class Folder(tempfile.TemporaryDirectory):
    """A folder with files, gone with the test."""

    def __enter__(self):
        return Files(super().__enter__())


class Files:
    def __init__(self, path):
        self.path = pathlib.Path(path)

    def __truediv__(self, name):
        return self.path / name

    def write(self, name, text):
        (self.path / name).write_text(text, encoding="utf-8")
        return self.path / name
