"""Assemblies of COMPAS (compas_assembly, compas_cra): their JSON as a model, and forces returned in the same format.

    assembly = talus.compas.load("arch.json")
    model = talus.compas.model(assembly, density=2400.0, normal_stiffness=1e11, shear_stiffness=1e10, friction_deg=35.0)
    talus.compas.save(talus.compas.with_forces(assembly, talus.Simulation(model)), "arch-with-forces.json")

An assembly is a graph as COMPAS 1 and 2 write it: a node has a ``block`` (a mesh of ``vertex`` and ``face``) and ``is_support``, an
edge (u, v) has ``interfaces``, each with ``points``, ``size``, ``frame`` and ``forces``. COMPAS itself is not needed.
"""

import copy
import json
import os
from typing import Any

import numpy as _np

from ._errors import ScenarioError
from ._model import Model
from ._run import Simulation

_DISTANCE = 1e-6  # of a block's size: how far off a face a corner may lie that counts as on it


def load(file: str | os.PathLike[str]) -> dict[str, Any]:
    """Reads an assembly's JSON as plain dictionaries and lists."""
    with open(os.fspath(file), encoding="utf-8") as stream:
        return json.load(stream)


def save(assembly: dict[str, Any], file: str | os.PathLike[str]) -> None:
    """Writes an assembly's JSON."""
    with open(os.fspath(file), "w", encoding="utf-8") as stream:
        json.dump(assembly, stream)


def model(
    assembly: dict[str, Any], *, density: float, normal_stiffness: float, shear_stiffness: float, friction_deg: float, **joint: Any
) -> Model:
    """The assembly as a talus.Model: one block per node, named after its key ("b0", ...), fixed where it is a support.

    density [kg/m^3]; normal_stiffness and shear_stiffness [Pa/m]; friction_deg [degrees]; joint: further keys of a joint.
    Coordinates are metres, z is up. Contacts follow from the faces, with a contact point at each corner of an interface, as in
    COMPAS. Raises ScenarioError for blocks that are not convex.
    """
    made = Model()
    made.contact(points="corner")
    made.material("default", density=density)
    made.joint("default", normal_stiffness=normal_stiffness, shear_stiffness=shear_stiffness, friction_deg=friction_deg, **joint)
    errors = []
    for key, node in _graph(assembly)["node"].items():
        vertices, faces = _mesh(key, node)
        if not _is_convex(vertices, faces):
            errors.append((None, None, None, f"node {key}", "found a mesh that is not convex, allowed: convex blocks"))
        made.block(_name(key), vertices=vertices.tolist(), fixed=_is_support(key, node))
    if errors:
        raise ScenarioError(errors)
    return made


def with_forces(assembly: dict[str, Any], simulation: Simulation | Model) -> dict[str, Any]:
    """A copy of the assembly whose edges have the interfaces of a simulation as it is now, with their forces [N].

    simulation: a talus.Simulation of ``model(assembly, ...)``, or such a model, then in its initial state.
    At each point of an interface ``c_np`` is the compression and ``c_nn`` the tension along the frame's z axis, which points from u
    to v; ``c_u`` and ``c_v`` are the shear along its x and y axes. Together they are the force on v. Edges between blocks that do
    not touch have no interfaces. Raises ScenarioError for a simulation of another assembly.
    """
    simulation = Simulation(simulation) if isinstance(simulation, Model) else simulation
    result = copy.deepcopy(assembly)
    graph = _graph(result)
    keys = {_name(key): key for key in graph["node"]}
    edges = graph["edge"]
    for u, others in _table(edges, "edge").items():
        for v, attributes in _table(others, f"edge {u}").items():
            _table(attributes, f"edge {u} {v}")["interfaces"] = []
    for block in simulation.blocks:
        if block not in keys:
            raise _fault("node", f"found no node of the block {block}, allowed: the assembly that the simulation was made of")
    contacts = simulation.contacts
    for interface in _np.unique(contacts.interface):
        points = _np.flatnonzero(contacts.interface == interface)
        a, b = (keys[simulation.blocks[block[points[0]]]] for block in (contacts.block_a, contacts.block_b))
        forward = b in edges.get(a, {}) or a not in edges.get(b, {})
        u, v, sign = (a, b, 1.0) if forward else (b, a, -1.0)
        found = _interface(contacts, points, sign, "value" if "value" in assembly else "data")
        edges.setdefault(u, {}).setdefault(v, {}).setdefault("interfaces", []).append(found)
    return result


def _interface(contacts, points, sign, content):
    """One interface in COMPAS' format; sign: -1 where its blocks are in the reverse order."""
    places, forces = contacts.position[points], sign * contacts.force[points]
    z = sign * contacts.normal[points[0]]
    x = places[1] - places[0]
    x = (x - z * (x @ z)) / _np.linalg.norm(x - z * (x @ z))
    y = _np.cross(z, x)
    frame = {"point": places.mean(axis=0).tolist(), "xaxis": x.tolist(), "yaxis": y.tolist()}
    data = {
        "points": [{"dtype": "compas.geometry/Point", content: place.tolist()} for place in places],
        "size": float(contacts.area[points].sum()),
        "frame": {"dtype": "compas.geometry/Frame", content: frame},
        "forces": [
            {"c_np": max(float(f @ z), 0.0), "c_nn": max(float(-f @ z), 0.0), "c_u": float(f @ x), "c_v": float(f @ y)} for f in forces
        ],
    }
    if content == "value":  # COMPAS 1
        data["type"] = "face_face"
    return {"dtype": "compas_assembly.datastructures/Interface", content: data}


def _content(thing):
    """The content of COMPAS' envelopes: {"dtype", "data"} in version 2, {"dtype", "value"} in 1, {"data", "datatype"} before."""
    while isinstance(thing, dict):
        inner = thing.get("data", thing.get("value")) if "dtype" in thing or "datatype" in thing else None
        if inner is None:
            return thing
        thing = inner
    return thing


def _graph(assembly):
    """The graph of nodes and edges inside the assembly: changes of it change the assembly."""
    content = _content(assembly)
    graph = _content(content["graph"]) if isinstance(content, dict) and "graph" in content else content
    if not isinstance(graph, dict) or "node" not in graph:
        raise _fault("assembly", "found no graph with nodes, allowed: the JSON of an assembly of compas_assembly")
    for key, node in _table(graph["node"], "node").items():
        _table(node, f"node {key}")
    graph.setdefault("edge", {})
    return graph


def _table(thing, field):
    """A dictionary for a JSON object; anything else is a fault of the file."""
    if not isinstance(thing, dict):
        raise _fault(field, f"found {json.dumps(thing, default=repr)[:40]}, allowed: a JSON object")
    return thing


def _fault(field, message):
    return ScenarioError([(None, None, None, field, message)])


def _mesh(key, node):
    """Corners as an array, faces as lists of their numbers."""
    mesh = _content(node.get("block"))
    try:
        numbers = {vertex: k for k, vertex in enumerate(mesh["vertex"])}
        vertices = _np.array([[at[axis] for axis in "xyz"] for at in mesh["vertex"].values()], dtype=float)
        faces = [[numbers[str(corner)] for corner in face] for face in mesh["face"].values()]
    except (AttributeError, KeyError, OverflowError, TypeError, ValueError):
        vertices, faces = [], []
    if len(vertices) == 0:
        raise _fault(f"node {key}", "found no block, allowed: a mesh of vertex and face")
    return vertices, faces


def _is_support(key, node):
    attributes = _table(_content(node["block"]).get("attributes", {}), f"node {key}, block, attributes")
    return bool(node.get("is_support") or attributes.get("is_support"))


def _is_convex(vertices, faces):
    """Whether all corners lie on one side of each face."""
    reach = _DISTANCE * _np.ptp(vertices, axis=0).max()
    for face in faces:
        corners = vertices[face]
        # Newell's normal: also of faces that are not quite plane, and whose first corners lie in a line.
        normal = _np.cross(corners, _np.roll(corners, -1, axis=0)).sum(axis=0)
        size = _np.linalg.norm(normal)
        if size == 0:
            continue
        heights = (vertices - corners.mean(axis=0)) @ (normal / size)
        if heights.max() > reach and heights.min() < -reach:
            return False
    return True


def _name(key):
    return f"b{key}"
