"""The base of a structure: all of its supports as one body, or the ground floor of a building of storeys."""

from dataclasses import dataclass

import numpy as np

from mouse_cli.model.geometry import DIRECTIONS
from mouse_cli.model.mesh import Mesh
from mouse_cli.model.problem import Problem

_LOADED = 0.02  # share of the largest load of its kind below which a direction is not loaded
_UPRIGHT = 0.999  # cosine of the angle between storeys of one building
_MOST = 60  # nodes of a base
SWAYING = ("storey", "spring")  # types of elements that resist the drift between floors; springs by the global axes


@dataclass(frozen=True)
class Base:
    """Nodes (ids) that are held; labels (c,): directions of theirs that are; pattern (c, 6): how a rigid body moves them."""

    numbers: tuple[int, ...]
    labels: tuple[str, ...]
    pattern: np.ndarray
    centre: tuple[float, ...]


@dataclass(frozen=True)
class Axis:
    """A direction (3 to 5) in which a building may turn about node (index) of its base; heights: what that moves, by label.

    along: the translation that it makes; inertia: that of the masses about their own axes.
    """

    node: int
    rotation: int
    along: int
    heights: dict[str, float]
    inertia: float


def base(problem: Problem) -> Base | None:
    """All supports together; None where they are one node, guide more than hold, or turn by themselves."""
    mesh, moving = problem.mesh, problem.mesh.moving
    held = [(node, d) for node, d in mesh.standing.tolist() if d in moving]
    nodes = sorted({node for node, _ in held})
    fewest = min((sum(n == node for n, _ in held) for node in nodes), default=0)
    if not 1 < len(nodes) <= _MOST or fewest < min(3, len(moving)) or moving <= {0, 1, 2}:
        return None
    centre = mesh.coordinates[nodes].mean(axis=0)
    pattern = np.array([rigid(mesh.coordinates[node] - centre)[d] for node, d in held])
    pattern[:, [d for d in range(6) if d not in moving]] = 0.0
    labels = tuple(f"{mesh.node_ids[node]}{DIRECTIONS[d]}" for node, d in held)
    return Base(tuple(int(mesh.node_ids[n]) for n in nodes), labels, pattern, tuple(centre.tolist()))


def rigid(at: np.ndarray) -> np.ndarray:
    """Motion (6, 6) of a point at (3,) from the origin by that of a rigid body there."""
    x, y, z = at
    found = np.eye(6)
    found[:3, 3:] = [[0, z, -y], [-z, 0, x], [y, -x, 0]]
    return found


def loaded(load: np.ndarray) -> list[int]:
    """Directions with a part of the largest load (6,), of translations and of rotations."""
    return [d for d in range(6) if load[d] > _LOADED * load[3 * (d // 3) :][:3].max() and load[d] > 0]


def axes(problem: Problem) -> list[Axis]:
    """Where storeys, or springs between floors, with masses may turn about their base: nothing else is there or holds them."""
    mesh = problem.mesh
    kinds = {each.type for each in mesh.elements}
    structure = problem.structure
    fixed = [m for m in (structure.K, structure.M) if m is not None and (m.nnz if hasattr(m, "nnz") else m.any())]
    own = [each for each in mesh.elements if each.type in SWAYING]
    if not own or not kinds <= {*SWAYING, "mass"} or fixed or mesh.links or mesh.gravity is not None:
        return []
    if any(each.nodes.shape[1] < 2 or each.options.get("axes") for each in own):
        return []
    if any(each.properties.get("preload", np.zeros(1)).any() for each in mesh.elements):
        return []
    grounded = sorted({node for node, d in mesh.supports.tolist() if d in mesh.directions})
    up = _upright(mesh)
    if len(grounded) != 1 or up is None:
        return []
    return [axis for d in range(3) if (axis := _axis(mesh, grounded[0], d, up)) is not None]


def _upright(mesh: Mesh) -> int | None:
    """The global axis that all storeys are along; None where two floors of one are at one place."""
    ends = np.concatenate([mesh.coordinates[each.nodes] for each in mesh.elements if each.type in SWAYING])
    along = np.abs(ends[:, 1] - ends[:, 0])
    along = along / np.maximum(np.linalg.norm(along, axis=1), 1e-300)[:, None]
    up = int(along[0].argmax())
    return up if (along[:, up] > _UPRIGHT).all() else None


def _axis(mesh: Mesh, node: int, along: int, up: int) -> Axis | None:
    """Turning by which all floors move in the direction `along`; None where it moves nothing or is in the model already."""
    rotation = 3 + (3 - along - up)
    if along == up or along not in mesh.directions or rotation in mesh.directions:
        return None
    turn, high = np.zeros(3), np.zeros(3)
    turn[rotation - 3], high[up] = 1.0, 1.0
    sense = float(np.cross(turn, high)[along])
    heights = sense * (mesh.coordinates[:, up] - mesh.coordinates[node, up])
    name = "J" + "xyz"[rotation - 3]
    masses = (each for each in mesh.elements if each.type == "mass")
    inertia = sum(float(each.properties[name].sum()) for each in masses if name in each.properties)
    moved = {f"{number}{DIRECTIONS[along]}": float(h) for number, h in zip(mesh.node_ids, heights, strict=True) if h}
    return Axis(node, rotation, along, moved, inertia) if moved else None
