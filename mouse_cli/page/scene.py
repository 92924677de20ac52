"""The structure that a page draws: nodes, lines, sensors, shapes and marked places, read from the key `geometry` of a document."""

import re
from dataclasses import dataclass

import numpy as np

from mouse_cli.report.reading import Part, rejected

_AMPLITUDE = 0.13  # largest displacement as drawn, by the size of the structure
_STILL = 1e-6  # an extent below this share of the size is none
_DOF = re.compile(r"(\d+)-?[TR][XYZ]")


@dataclass(frozen=True)
class Shape:
    """One mode: u (k, 3), largest 1; tested: node and displacement (3,) of each place where a test read the shape."""

    mode: str
    hz: float | None
    u: np.ndarray
    tested: tuple[tuple[int, np.ndarray], ...]


@dataclass(frozen=True)
class Scene:
    """positions (k, 3), those of `nodes` nodes, then points between; lines (l, 2); elements: points of each by its id.

    names: node by its name; sensors: node by its dof; of: nodes that the model has.
    across: motion along a line of nodes is drawn across it, else nobody would see it.
    """

    positions: np.ndarray
    lines: np.ndarray
    elements: dict[str, list[int]]
    names: dict[str, int]
    sensors: dict[str, int]
    shapes: tuple[Shape, ...]
    unit: str
    of: int
    nodes: int
    across: bool = False

    @property
    def size(self) -> float:
        """Diagonal of the structure."""
        return float(np.linalg.norm(np.ptp(self.positions, axis=0))) or 1.0

    @property
    def amplitude(self) -> float:
        """Length as which a displacement of 1 is drawn."""
        return _AMPLITUDE * self.size

    @property
    def axes(self) -> tuple[int, ...]:
        """Axes in which the structure extends or moves: two of them where the drawing may be flat, else all three."""
        moves = [np.abs(shape.u).max(axis=0) for shape in self.shapes]
        reach = np.ptp(self.positions, axis=0) / self.size + np.max([np.zeros(3), *moves], axis=0)
        found = [i for i in range(3) if reach[i] > _STILL]
        for more in (0, 2, 1):
            if len(found) < 2 and more not in found:
                found.append(more)
        return tuple(sorted(found))

    def node(self, name: str) -> int | None:
        """Index of the node that a degree of freedom or a node so called is at."""
        dof = _DOF.fullmatch(name)
        return self.sensors.get(name, self.names.get(dof[1] if dof else name))


def scene(document: Part) -> Scene | None:
    """The scene of a document; None without positions. Raises DeckError (MD922)."""
    part = document.part("geometry")
    positions = np.array(part.vectors("positions", 3), float).reshape(-1, 3)
    k = len(positions)
    if not k:
        return None
    lines = np.array(_indices(part, "lines", k, 2), int).reshape(-1, 2)
    elements = {str(id_): nodes for id_, *nodes in _indices(part, "elements", k)}
    names = {name: i for i, name in enumerate(part.labels("nodes")[:k])}
    sensors = part.parts("sensors")
    at = {each.label("dof"): _node(each, k) for each in sensors}
    shapes = tuple(_shape(each, sensors, k) for each in part.parts("shapes"))
    found = Scene(
        positions, lines, elements, names, at, shapes, part.text("unit"), int(part.number("of") or k), len(names) or k
    )
    return _across(found)


def _shape(part: Part, sensors: list[Part], k: int) -> Shape:
    u = np.array(part.vectors("displacements", 3), float).reshape(-1, 3)
    if len(u) != k:
        raise rejected("MD922", f"{part.file}: {part.place}.displacements has {len(u)} rows; expected {k}, one a node")
    moved: dict[int, np.ndarray] = {}
    for sensor, test, model in zip(sensors, part.numbers("test"), part.numbers("model"), strict=False):
        direction = sensor.numbers("direction")
        if test is None or model is None or len(direction) != 3 or None in direction:
            continue
        node = _node(sensor, k)
        moved[node] = moved.get(node, u[node]) + (test - model) * np.array(direction, float)
    return Shape(part.label("mode"), part.number("hz"), u, tuple(moved.items()))


def _across(found: Scene) -> Scene:
    """The scene with motion turned by a right angle where nodes lie, and move, along one axis alone."""
    extent = np.ptp(found.positions, axis=0) > _STILL * found.size
    moves = np.max([np.zeros(3), *(np.abs(s.u).max(axis=0) for s in found.shapes)], axis=0) > _STILL
    if not found.shapes or extent.sum() != 1 or not (extent == moves).all():
        return found
    along = int(np.flatnonzero(extent)[0])
    turn = np.zeros((3, 3))
    turn[along, {0: 2, 1: 2, 2: 0}[along]] = 1.0
    shapes = tuple(
        Shape(s.mode, s.hz, s.u @ turn, tuple((node, v @ turn) for node, v in s.tested)) for s in found.shapes
    )
    return Scene(**{**vars(found), "shapes": shapes, "across": True})


def _indices(part: Part, key: str, k: int, width: int | None = None) -> list[list[int]]:
    """Rows of indices of nodes; in `elements` an id stands before them."""
    rows = [[int(x) for x in row] for row in part.vectors(key, width)]
    skip = int(width is None)
    if any(len(row) <= skip or min(row[skip:]) < 0 or max(row[skip:]) >= k for row in rows):
        raise rejected("MD922", f"{part.file}: {part.place}.{key} names a node that is not there")
    return rows


def _node(part: Part, k: int) -> int:
    value = part.number("node")
    if value is None or not 0 <= value < k:
        raise rejected("MD922", f"{part.file}: {part.place}.node names a node that is not there")
    return int(value)
