"""Models: a scenario file's tables, read or built in code."""

import copy
import functools
import html
import json
import os
import tomllib

from . import _core, _toml
from ._errors import ScenarioError, path_of


@functools.cache
def _sections():
    """The sections of a scenario file: {"joint": "named", "bolt": "list", "gravity": "single", ...}."""
    def kind(schema):
        if schema["type"] == "array":
            return "list"
        return "named" if isinstance(schema.get("additionalProperties"), dict) else "single"

    properties = json.loads(_core.scenario_schema())["properties"]
    return {name: kind(schema) for name, schema in properties.items()}


class Model:
    """A slope: the content of a scenario file, with the file's keys and units.

    One method per section of the file builds it in code, with the file's keys as arguments; each returns the model::

        model = talus.Model()
        model.material("rock", density=2700.0)                          # kg/m^3
        model.joint("default", normal_stiffness=1e10, shear_stiffness=1e10, friction_deg=30.0)   # Pa/m, degrees
        model.block("floor", box=dict(min=[-5, -5, -1], max=[5, 5, 0]), fixed=True)              # m
        model.block("key", box=dict(min=[0, 0, 0], max=[1, 1, 1]))
        model.gravity(tilt_deg=20.0)

    ``model["joint.default.friction_deg"] = 25`` changes one field by its name in messages; ``model[...]`` reads a given value and
    raises KeyError for one that is not given. Values are checked when the model is used or ``validate()`` is called.

    The reference of all keys, with their units, ranges and defaults, is the guide's page "Keys".
    """

    def __init__(self, tables=None, *, folder=""):
        """tables: those of a scenario as dictionaries and lists. folder: the folder of its mesh files."""
        self._tables = copy.deepcopy(dict(tables)) if tables else {}
        self._path = os.path.join(path_of(folder), "model") if folder else "model"
        self._scenario = None

    @classmethod
    def _loaded(cls, scenario):
        model = cls()
        model._tables = tomllib.loads(scenario.text)
        model._path = scenario.path
        model._scenario = scenario
        return model

    # --- building -------------------------------------------------------------------------------------------------------

    def add(self, section, name=None, /, **keys):
        """Adds a table to a list ([[block]]), a named table ([joint.NAME]), or keys to a single table ([gravity])."""
        kind = _sections().get(section)
        if kind == "list":
            if name is not None:
                keys = {"name": name, **keys}
            self._tables.setdefault(section, []).append(keys)
        elif kind == "named":
            self._tables.setdefault(section, {}).setdefault(name or "default", {}).update(keys)
        else:
            self._tables.setdefault(section, {}).update(keys)
        return self._changed()

    def stack(self, **keys):
        """A regular stack of blocks on a fixed floor: columns, rows, slices; block [m], material, heights, bond, ..."""
        return self.add("stack", **keys)

    def block(self, name, **keys):
        """A block: box (min, max) or vertices [m], material, joint, fixed, driven, velocity [m/s]."""
        return self.add("block", name, **keys)

    def material(self, name, **keys):
        """A material: density [kg/m^3]."""
        return self.add("material", name, **keys)

    def joint(self, name="default", **keys):
        """A kind of joint: stiffnesses [Pa/m], friction_deg, cohesion and tensile_strength [Pa], law, ..."""
        return self.add("joint", name, **keys)

    def interface(self, block_a, block_b, **keys):
        """The joint of one pair of blocks: joint (its name), or properties that differ from the pair's joint."""
        return self.add("interface", between=[block_a, block_b], **keys)

    def water(self, **keys):
        """Water in a fissure, on a face or in a joint: depth or elevation [m], density [kg/m^3], ..."""
        return self.add("water", **keys)

    def load(self, **keys):
        """A force on a block [N], or a pressure on faces [Pa]."""
        return self.add("load", **keys)

    def bolt(self, name=None, **keys):
        """A bolt from head to end [m]."""
        return self.add("bolt", name, **keys)

    def bolt_pattern(self, name=None, **keys):
        """A grid of bolts with heads on the free faces inside a box: spacing and length [m], plunge_deg, trend_deg, ..."""
        return self.add("bolt_pattern", name, **keys)

    def rock_mass(self, **keys):
        """A region that joints cut into blocks: region (a box, a profile or a mesh) [m], material, fixed, ..."""
        return self.add("rock_mass", **keys)

    def joint_set(self, name=None, **keys):
        """A set of parallel joints through the rock mass: dip_deg, dip_direction_deg, spacing [m], ..."""
        return self.add("joint_set", name, **keys)

    def single_joint(self, name=None, **keys):
        """One joint in the rock mass: point [m], dip_deg, dip_direction_deg, radius [m], ..."""
        return self.add("single_joint", name, **keys)

    def gravity(self, **keys):
        """Gravity: magnitude [m/s^2]; tilt_deg, positive downhill towards -x; or direction."""
        return self.add("gravity", **keys)

    def analysis(self, **keys):
        """Settings of searches: start_deg, stop_deg, tolerance_deg, factor_tolerance [-], ..."""
        return self.add("analysis", **keys)

    def run(self, **keys):
        """Settings of time histories: duration_s, frame_interval_s, time_step_s, watch (block names), start."""
        return self.add("run", **keys)

    def damping(self, **keys):
        """Damping: mass and rotation [1/s], contact [s], local (0..1)."""
        return self.add("damping", **keys)

    def contact(self, **keys):
        """Contacts: points, the rule by which contact points lie on a patch."""
        return self.add("contact", **keys)

    def seismic(self, **keys):
        """A pseudo-static earthquake: horizontal and vertical shares of the weight, direction_deg."""
        return self.add("seismic", **keys)

    def ground_motion(self, **keys):
        """Motion of the fixed blocks: file, scale [-], baseline."""
        return self.add("ground_motion", **keys)

    # --- fields ---------------------------------------------------------------------------------------------------------

    def __getitem__(self, field):
        """The given value of a field: ``model["joint.default.friction_deg"]``, ``model["block[2].box.min[0]"]``; else KeyError."""
        node = self._tables
        for part in _parts(field):
            try:
                node = node[part]
            except (KeyError, IndexError, TypeError):
                raise KeyError(field) from None
        return node

    def __setitem__(self, field, value):
        *way, last = _parts(field)
        node = self._tables
        for part in way:
            if isinstance(node, dict) and part not in node and isinstance(part, str):
                node[part] = {}
            try:
                node = node[part]
            except (IndexError, TypeError, KeyError):
                raise KeyError(field) from None
        try:
            node[last] = value
        except (IndexError, TypeError):
            raise KeyError(field) from None
        self._changed()

    def __delitem__(self, field):
        *way, last = _parts(field)
        node = self._tables
        try:
            for part in way:
                node = node[part]
            del node[last]
        except (KeyError, IndexError, TypeError):
            raise KeyError(field) from None
        self._changed()

    def copy(self):
        """An independent model with the same tables."""
        twin = Model()
        twin.__dict__.update(self.__dict__, _tables=copy.deepcopy(self._tables))
        return twin

    # --- reading --------------------------------------------------------------------------------------------------------

    @property
    def tables(self):
        """The tables as dictionaries and lists (a copy)."""
        return copy.deepcopy(self._tables)

    def to_toml(self):
        """The model as the text of a scenario file; for an unchanged loaded file, its own text."""
        return self._scenario.text if self._scenario else _toml.text_of(self._tables)

    def save(self, file):
        """Writes the text of ``to_toml()`` to a file. Raises OSError."""
        with open(file, "w", encoding="utf-8") as out:
            out.write(self.to_toml())

    def validate(self, threads=0):
        """Raises ScenarioError with all faults: unknown keys, values out of range, blocks that overlap, water on no face."""
        self._read().check(threads)

    @property
    def blocks(self):
        """Names of all blocks, in the order of the arrays of a Simulation."""
        return self._read().blocks

    @property
    def warnings(self):
        """Warnings of the reader about a model without faults."""
        return self._read().warnings

    def picture(self, azimuth_deg=235.0, elevation_deg=25.0):
        """The blocks as an SVG picture, seen from azimuth_deg (clockwise from north, +y) and elevation_deg above the horizon."""
        return self._read().picture(azimuth_deg, elevation_deg)

    @property
    def path(self):
        """The model's name in messages; its folder is that of its mesh files."""
        return self._path

    def _read(self):
        if self._scenario is None:
            self._scenario = _core.parse(_toml.text_of(self._tables), self._path)
        return self._scenario

    def _changed(self):
        # Lines of messages are those of to_toml() from now on, so the file is not called by its own name.
        if self._scenario is not None and not self._path.endswith(" (changed)") and self._path != "model":
            self._path += " (changed)"
        self._scenario = None
        return self

    def __repr__(self):
        sections = ", ".join(
            f"{len(value)} {key}" if isinstance(value, list) else key for key, value in self._tables.items()
        )
        return f"<talus.Model {self._path}: {sections}>"

    def _repr_html_(self):
        try:
            shown = f"<div style='max-width:32rem'>{self.picture()}</div>"
        except ScenarioError as error:
            shown = f"<pre>{html.escape(str(error))}</pre>"
        return f"{shown}<details><summary>{html.escape(repr(self))}</summary><pre>{html.escape(self.to_toml())}</pre></details>"


def _parts(field):
    """"block[2].box" -> ["block", 2, "box"]; a name with dots stands in quotes: joint."a.b".friction_deg."""
    parts = []
    for key in _keys(field):
        name, *indices = key.split("[") if not key.startswith('"') else [key.strip('"')]
        parts.append(name)
        try:
            parts += [int(index.removesuffix("]")) for index in indices]
        except ValueError:
            raise KeyError(field) from None
    return parts


def _keys(field):
    """The keys of a field, split at dots outside of quotes."""
    keys, quoted = [""], False
    for letter in field:
        if letter == '"':
            quoted = not quoted
        if letter == "." and not quoted:
            keys.append("")
        else:
            keys[-1] += letter
    return keys
