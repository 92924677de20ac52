"""From points in space to points of a drawing: a view of a scene, fitted to the room that there is."""

from dataclasses import dataclass

import numpy as np

from mouse_cli.page.scene import Scene

TURNS, TILT = (30.0, 60.0), 24.0  # degrees, of the first view of a structure in space: the turn that shows it larger
_NAMES = "xyz"


@dataclass(frozen=True)
class View:
    """matrix (2, 3): across and upward, of a point; scale and middle (2,): of the fit.

    turn: in degrees, None where there is one view alone.
    """

    matrix: np.ndarray
    turn: float | None
    scale: float
    middle: np.ndarray
    width: float
    height: float

    def at(self, points: np.ndarray) -> np.ndarray:
        """Places (k, 2) in the drawing, downward from its upper left corner."""
        off = (points @ self.matrix.T - self.middle) * self.scale
        return np.column_stack([self.width / 2 + off[:, 0], self.height / 2 - off[:, 1]])

    def axes(self, length: float) -> list[tuple[str, np.ndarray]]:
        """The axes that are seen as arrows of the drawing, by name."""
        found = [(_NAMES[i], self.matrix[:, i] * length * np.array([1, -1])) for i in range(3)]
        return [(name, arrow) for name, arrow in found if np.linalg.norm(arrow) > 1e-9]


def turned(turn: float, tilt: float) -> np.ndarray:
    """(2, 3): the structure turned about z by `turn`, seen from `tilt` above the horizon, degrees.

    >>> (turned(0.0, 0.0).round(3) + 0.0).tolist()
    [[1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]
    """
    a, e = np.radians([turn, tilt])
    across = [np.cos(a), -np.sin(a), 0.0]
    upward = [np.sin(a) * np.sin(e), np.cos(a) * np.sin(e), np.cos(e)]
    return np.array([across, upward])


def view(scene: Scene, width: float, highest: float, margin: float) -> View:
    """The first view of `scene`: straight on where it is flat, from above where it is not."""
    axes = scene.axes
    if len(axes) == 2:
        return _fitted(scene, np.eye(3)[list(axes)], None, width, highest, margin)
    found = [_fitted(scene, turned(turn, TILT), turn, width, highest, margin) for turn in TURNS]
    return max(found, key=lambda one: one.scale)


def _fitted(scene: Scene, matrix: np.ndarray, turn: float | None, width: float, highest: float, margin: float) -> View:
    low, high = _bounds(scene, matrix)
    span = np.maximum(high - low, 1e-9 * scene.size)
    scale = float(min((width - 2 * margin) / span[0], (highest - 2 * margin) / span[1]))
    height = float(np.clip(span[1] * scale + 2 * margin, highest / 3, highest))
    return View(matrix, turn, scale, (low + high) / 2, width, height)


def _bounds(scene: Scene, matrix: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The corners of all that is drawn, in any mode and phase."""
    rest = scene.positions @ matrix.T
    reach = [np.abs(s.u @ matrix.T) for s in scene.shapes]
    reach = scene.amplitude * np.max([np.zeros_like(rest), *reach], axis=0)
    return (rest - reach).min(axis=0), (rest + reach).max(axis=0)
