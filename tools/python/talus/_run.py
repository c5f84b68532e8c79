"""Motion: a simulation taken step by step, and runs read from snapshot files, as numpy arrays."""

import functools

from . import _core
from ._errors import path_of
from ._model import Model
from ._result import frame_of


class Contacts:
    """Contact points at one instant, an entry each, in the model frame (numpy arrays of n, or of (n, 3)).

    position [m] on block a's face; normal, unit, from a to b; gap [m], 0 where it closed and negative when pressed; area [m^2];
    force on b by its springs [N], with shear its part in the face and normal_force its size along the normal, compression
    positive; water_force [N]; mobilised, shear force over strength, 0..1; state: 0 open, 1 sticking, 2 slipping; interface,
    block_a, block_b, joint: indices.
    """

    OPEN, STICKING, SLIPPING = 0, 1, 2

    def __init__(self, arrays):
        self.__dict__.update(arrays)

    def __len__(self):
        return len(self.gap)

    def __repr__(self):
        return f"<talus.Contacts: {len(self)} points>"


class Simulation:
    """A time history that is taken by hand.

    It begins as ``talus.run`` does (in equilibrium under weight and water where there is one), and passes through the same bits in
    whole tens of steps. ``positions``, ``velocities`` and ``quaternions`` are views of the simulation's own memory: an array taken
    once shows the latest step, nothing is copied. They can be read only.
    """

    def __init__(self, model, *, threads=0, progress=None):
        scenario = (model if isinstance(model, Model) else Model._loaded(_core.read(path_of(model))))._read()
        self._core = _core.Simulation(scenario, threads, progress)
        self.blocks = scenario.blocks
        """Names, in the order of the arrays."""

    def step(self, count=1, *, progress=None):
        """Takes steps of ``time_step`` seconds; Ctrl-C leaves it at the end of one."""
        self._core.step(count, progress)

    @property
    def positions(self):
        """Centroids, (blocks, 3) [m]."""
        return self._core.positions

    @property
    def velocities(self):
        """Of the centroids, (blocks, 3) [m/s]."""
        return self._core.velocities

    @property
    def quaternions(self):
        """w, x, y, z from each block's own frame (its principal axes) to the model frame, (blocks, 4)."""
        return self._core.quaternions

    @property
    def contacts(self):
        """Contact points as they are now (made anew at every call)."""
        return Contacts(self._core.contacts())

    @property
    def time(self):
        """Simulated [s]."""
        return self._core.time

    @property
    def steps(self):
        """Taken so far."""
        return self._core.steps

    @property
    def time_step(self):
        """Of the next step [s]."""
        return self._core.time_step

    @property
    def start(self):
        """What it started from: "equilibrium", "held" or "unstressed"."""
        return self._core.start

    @property
    def kinetic_energy(self):
        """[J]"""
        return self._core.energies()[0]

    @property
    def elastic_energy(self):
        """In the contact springs [J]."""
        return self._core.energies()[1]

    @property
    def gravity_energy(self):
        """Relative to the start [J]."""
        return self._core.energies()[2]

    @property
    def out_of_balance(self):
        """Largest out-of-balance force of a free block over its weight."""
        return self._core.energies()[3]

    @property
    def state_hash(self):
        """16 hex digits over the state, as in results."""
        return self._core.state_hash

    def __repr__(self):
        return f"<talus.Simulation: {len(self.blocks)} blocks, step {self.steps}, t = {self.time:g} s>"


class Run:
    """A run read from a snapshot file; its arrays are read when one is first asked for."""

    def __init__(self, file):
        self._core = _core.Snapshots(path_of(file))
        self.file = path_of(file)

    @property
    def blocks(self):
        """Names, in the order of the arrays."""
        return self._core.names

    @property
    def masses(self):
        """Of the blocks [kg]."""
        return self._core.masses

    @property
    def ended(self):
        """"finished", "interrupted" or "failed"; None when it has not come to its end."""
        return self._core.ended

    @property
    def faults(self):
        """What is missing or damaged in the file, for people."""
        return self._core.faults

    @property
    def model(self):
        """The model it was run from."""
        return Model._loaded(_core.parse(self._core.scenario_text, self._core.scenario_path))

    @functools.cached_property
    def _arrays(self):
        return self._core.arrays()

    @property
    def times(self):
        """Of the frames [s]."""
        return self._arrays["times"]

    @property
    def steps(self):
        """Of the frames."""
        return self._arrays["steps"]

    @property
    def tilts_deg(self):
        """Of gravity [degrees]."""
        return self._arrays["tilts_deg"]

    @property
    def positions(self):
        """Centroids, (frames, blocks, 3) [m]; displacements are kept in single precision."""
        return self._arrays["positions"]

    @property
    def displacements(self):
        """Of the centroids since the start, (frames, blocks, 3) [m]."""
        return self._arrays["displacements"]

    @property
    def velocities(self):
        """Of the centroids, (frames, blocks, 3) [m/s]."""
        return self._arrays["velocities"]

    @property
    def rotations(self):
        """Since the start, axis times angle, (frames, blocks, 3) [rad]."""
        return self._arrays["rotations"]

    @property
    def kinetic_energy_j(self):
        """Per frame [J]."""
        return self._arrays["kinetic_energy_j"]

    @property
    def elastic_energy_j(self):
        """Per frame, in the contact springs [J]."""
        return self._arrays["elastic_energy_j"]

    @property
    def gravity_energy_j(self):
        """Per frame, relative to the start [J]."""
        return self._arrays["gravity_energy_j"]

    @property
    def state_hashes(self):
        """Per frame."""
        return self._arrays["state_hashes"]

    def contacts(self, frame=-1):
        """Contact points of the full state at a frame, or the last one before it."""
        return Contacts(self._core.contacts(frame))

    def page(self):
        """The page of ``talus replay`` that plays the run in a browser, as HTML."""
        return self._core.page()

    def __len__(self):
        return len(self._core)

    def _repr_html_(self):
        return frame_of(self.page())

    def __repr__(self):
        return f"<talus.Run {self.file}: {len(self)} frames of {len(self.blocks)} blocks, {self.ended or 'unfinished'}>"


def open(file):  # noqa: A001, the name the contract gives it
    """Opens a snapshot file of ``talus.run`` (.mcap)."""
    return Run(file)
