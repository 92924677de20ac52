"""Small meshes for the tests of the element library."""

from typing import Any

import numpy as np

from mouse_cli.dynamics.solver import eigensolution
from mouse_cli.model.arrays import dense
from mouse_cli.model.mesh import Binding, ElementSet, Mesh
from mouse_cli.terms.assembly import Assembly
from mouse_cli.terms.build import Built, built

XY = (0, 1, 5)  # directions of the plane XY
STEEL = {"E": 2.1e11, "density": 7850.0, "nu": 0.3}
BAR = {"A": 3e-4, "Iy": 4e-9, "Iz": 9e-9, "J": 1e-8}


def elements(type: str, nodes: Any, first: int = 1, options: dict | None = None, **properties: Any) -> ElementSet:
    """A set with the same (or listed) properties for every element."""
    nodes = np.asarray(nodes)
    values = {name: np.broadcast_to(np.asarray(v, float), len(nodes)) for name, v in properties.items()}
    return ElementSet(type, np.arange(first, first + len(nodes)), nodes, values, options or {})


def pairs(count: int, start: int = 0) -> np.ndarray:
    """Neighbours in a row of nodes."""
    return np.arange(start, start + count)[:, None] + [0, 1]


def mesh(coordinates: Any, sets: list[ElementSet], supports: Any = (), **more: Any) -> Mesh:
    """Nodes numbered from 1; supports as (node index, directions)."""
    coordinates = np.asarray(coordinates, float)
    held = [(node, d) for node, directions in supports for d in directions]
    ids = np.arange(1, len(coordinates) + 1)
    return Mesh(ids, coordinates, tuple(sets), np.array(held, int).reshape(-1, 2), **more)


def beam_line(count: int, length: float = 1.0, supports: Any = (), options: dict | None = None, **more: Any) -> Mesh:
    """A straight beam of `count` elements along X in the plane XY."""
    extra = {name: more.pop(name) for name in list(more) if name not in ("links", "gravity", "directions")}
    properties = {**STEEL, **BAR, **extra}
    points = np.zeros((count + 1, 3))
    points[:, 0] = np.linspace(0.0, length, count + 1)
    more.setdefault("directions", XY)
    return mesh(points, [elements("beam", pairs(count), options=options, **properties)], supports, **more)


def matrices(given: Mesh, bindings: tuple[Binding, ...] = (), theta: Any = ()) -> tuple[np.ndarray, np.ndarray]:
    """Dense K and M."""
    model = built(given, bindings)
    K, M = Assembly(model.structure, model.terms, len(theta)).matrices(np.asarray(theta, float))
    return dense(K), dense(M)


def damping(given: Mesh) -> tuple[np.ndarray | None, np.ndarray | None]:
    """C and D."""
    model = built(given)
    return Assembly(model.structure, model.terms, 0).damping(np.zeros(0))


def hertz(given: Mesh) -> np.ndarray:
    """Natural frequencies of the model."""
    return eigensolution(*matrices(given)).frequencies_hz


def rigid(model: Built, given: Mesh) -> np.ndarray:
    """Rigid-body motions (n, 6) of the degrees of freedom: u + theta x r."""
    geometry = model.structure.geometry
    found = np.zeros((model.structure.n, 6))
    for i, (node, d) in enumerate(zip(geometry.node, geometry.direction, strict=True)):
        if d > 2:
            found[i, d] = 1.0
            continue
        found[i, d] = 1.0
        for axis in range(3):
            found[i, 3 + axis] = np.cross(np.eye(3)[axis], given.coordinates[node])[d]
    return found
