"""Where the sensors of a universal file stand and point: nodes of data sets 15 and 2411 with the coordinate systems of 2420."""

from dataclasses import dataclass

import numpy as np

from mouse_cli.formats.data_files import reject
from mouse_cli.formats.recording_files.universal_blocks import blocks
from mouse_cli.model.geometry import DIRECTIONS

_CARTESIAN, _CYLINDRICAL = 0, 1


@dataclass(frozen=True)
class _System:
    """kind: of coordinates; axes (3, 3): its unit vectors as rows; origin (3,). A point is origin + (x, y, z) axes."""

    kind: int
    axes: np.ndarray
    origin: np.ndarray

    def point(self, given: np.ndarray) -> np.ndarray:
        """The point (3,) in global axes; of a cylindrical system from r, theta in degrees, and z."""
        if self.kind == _CYLINDRICAL:
            angle = np.deg2rad(given[1])
            given = np.array([given[0] * np.cos(angle), given[0] * np.sin(angle), given[2]])
        return self.origin + given @ self.axes

    def directions(self, at: np.ndarray) -> np.ndarray:
        """Unit vectors (3, 3) of its directions at a point in global axes: radial, tangential and axial of a cylindrical one."""
        if self.kind == _CARTESIAN:
            return self.axes
        x, y, _ = (at - self.origin) @ self.axes.T
        angle = np.arctan2(y, x)
        cos, sin = np.cos(angle), np.sin(angle)
        return np.array([[cos, sin, 0.0], [-sin, cos, 0.0], [0.0, 0.0, 1.0]]) @ self.axes


_GLOBAL = _System(_CARTESIAN, np.eye(3), np.zeros(3))
Survey = dict[str, tuple[tuple, tuple]]  # coordinates (3) and direction (6) by `12TY`


def survey(path: str, data: bytes, names: tuple[str, ...]) -> Survey:
    """Place and direction of each of `names` whose node the file has. Raises DeckError (MD252)."""
    systems, nodes = {0: _GLOBAL, 1: _GLOBAL}, []
    for block in blocks(data):
        if block.number in (15, 2411, 2420):
            lines = [line for line in bytes(block.content).decode("latin-1").splitlines() if line.strip()]
            if block.number == 2420:
                systems |= _systems(path, lines)
            else:
                nodes += _nodes(path, lines, block.number)
    at = {}
    for node, defined, moved, given in nodes:
        known = systems.get(defined, _GLOBAL), systems.get(moved, _GLOBAL)
        where = known[0].point(np.array(given))
        at[node] = where, known[1].directions(where)
    found = {}
    for name in names:
        node, direction = int(name[:-2]), DIRECTIONS.index(name[-2:])
        if node in at:
            vector = np.zeros(6)
            turning = 3 * (direction // 3)
            vector[turning : turning + 3] = at[node][1][direction % 3]
            found[name] = tuple(at[node][0].tolist()), tuple(vector.tolist())
    return found


def _nodes(path: str, lines: list[str], number: int) -> list[tuple[int, int, int, list[float]]]:
    """Node, system of its coordinates, system of its motion, and coordinates; those of 2411 are global."""
    pairs = [(line, line) for line in lines] if number == 15 else list(zip(lines[::2], lines[1::2], strict=False))
    try:
        found = []
        for head, body in pairs:
            node, defined, moved = (int(word) for word in head.split()[:3])
            given = [float(word.replace("D", "E")) for word in body.split()[4 if number == 15 else 0 :][:3]]
            found.append(
                (node, defined if number == 15 else 0, moved, given if len(given) == 3 else _short(path, node))
            )
        return found
    except ValueError:
        reject("MD252", path, f"data set {number} has a node that cannot be read", "export the geometry again")


def _short(path: str, node: int) -> None:
    reject("MD252", path, f"node {node} has no three coordinates", "export the geometry again")


def _systems(path: str, lines: list[str]) -> dict[int, _System]:
    """Coordinate systems of data set 2420: two lines of the part, then six of each."""
    found = {}
    try:
        for i in range(2, len(lines) - 5, 6):
            label, kind = (int(word) for word in lines[i].split()[:2])
            rows = np.array(
                [[float(word.replace("D", "E")) for word in line.split()[:3]] for line in lines[i + 2 : i + 6]]
            )
            if kind not in (_CARTESIAN, _CYLINDRICAL):
                reject("MD252", path, f"coordinate system {label} is spherical", "export cartesian or cylindrical ones")
            found[label] = _System(kind, rows[:3], rows[3])
    except (ValueError, IndexError):
        reject("MD252", path, "data set 2420 cannot be read", "export the geometry again")
    return found
