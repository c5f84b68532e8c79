"""Motion: a simulation taken step by step, and runs read from snapshot files, as numpy arrays."""

import functools

from . import _core
from ._errors import path_of
from ._model import Model
from ._result import frame_of


class Contacts:
    """The n contact points at one instant, in the model frame, as numpy arrays of shape (n,) or (n, 3).

    - position (n, 3) [m]: on block a's face
    - normal (n, 3): unit vector from a to b
    - gap (n,) [m]: 0 at closure, negative when pressed
    - area (n,) [m^2]: tributary area
    - force (n, 3) [N]: of the springs on b; shear (n, 3) [N]: its part in the face
    - normal_force (n,) [N]: effective, compression positive; water_force (n,) [N]
    - mobilised (n,): shear force over shear strength, 0..1
    - state (n,): OPEN, STICKING or SLIPPING
    - interface, block_a, block_b, joint (n,): indices
    """

    OPEN, STICKING, SLIPPING = 0, 1, 2

    def __init__(self, arrays):
        self.__dict__.update(arrays)

    def __len__(self):
        return len(self.gap)

    def __repr__(self):
        return f"<talus.Contacts: {len(self)} points>"


class Simulation:
    """A time history taken step by step.

    It begins as ``talus.run`` does (in equilibrium under weight and water where there is one) and gives the same bits after
    every ten steps. ``positions``, ``velocities`` and ``quaternions`` are read-only views of the simulation's memory: an array
    obtained once always shows the latest step.
    """

    def __init__(self, model, *, threads=0, progress=None):
        scenario = (model if isinstance(model, Model) else Model._loaded(_core.read(path_of(model))))._read()
        self._core = _core.Simulation(scenario, threads, progress)
        self.blocks = scenario.blocks
        """Names, in the order of the arrays."""

    def step(self, count=1, *, progress=None):
        """Takes ``count`` steps of ``time_step`` seconds; Ctrl-C stops after a whole step.

        Raises ScenarioError if motion becomes infinite.
        """
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
        """Number of steps taken."""
        return self._core.steps

    @property
    def time_step(self):
        """Of the next step [s]."""
        return self._core.time_step

    @property
    def start(self):
        """The initial state: "equilibrium"; "held" (with unbreakable joints, released at time 0); or "unstressed"."""
        return self._core.start

    @property
    def kinetic_energy(self):
        """Kinetic energy [J]."""
        return self._core.energies()[0]

    @property
    def elastic_energy(self):
        """Elastic energy of contacts and bolts [J]."""
        return self._core.energies()[1]

    @property
    def gravity_energy(self):
        """Potential energy relative to the start [J]."""
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
    """A run read from a snapshot file (.mcap). The arrays are read on first use. Raises ScenarioError for an unreadable one."""

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
        """Missing or damaged parts of the file, in words; empty for a sound one."""
        return self._core.faults

    @property
    def model(self):
        """The model of the run."""
        return Model._loaded(_core.parse(self._core.scenario_text, self._core.scenario_path))

    @functools.cached_property
    def _arrays(self):
        return self._core.arrays()

    @property
    def times(self):
        """Times of the frames, (frames,) [s]."""
        return self._arrays["times"]

    @property
    def steps(self):
        """Steps at the frames, (frames,)."""
        return self._arrays["steps"]

    @property
    def tilts_deg(self):
        """Tilts of gravity, (frames,) [degrees]."""
        return self._arrays["tilts_deg"]

    @property
    def positions(self):
        """Centroids, (frames, blocks, 3) [m]; the file has displacements in single precision."""
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
        """Kinetic energy, (frames,) [J]."""
        return self._arrays["kinetic_energy_j"]

    @property
    def elastic_energy_j(self):
        """Elastic energy of contacts and bolts, (frames,) [J]."""
        return self._arrays["elastic_energy_j"]

    @property
    def gravity_energy_j(self):
        """Potential energy relative to the start, (frames,) [J]."""
        return self._arrays["gravity_energy_j"]

    @property
    def state_hashes(self):
        """State hashes, one text of 16 hex digits per frame."""
        return self._arrays["state_hashes"]

    def contacts(self, frame=-1):
        """Contact points of the full state at a frame, or of the last one before it. Raises ScenarioError where there is none."""
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


def open(file):  # noqa: A001, as in other readers of files
    """Opens a snapshot file of ``talus.run`` (.mcap) as a Run. Raises ScenarioError for a file without snapshots."""
    return Run(file)
