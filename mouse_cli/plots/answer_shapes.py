"""Of an answer in JSON: mode shapes of the revised model, drawn on the structure."""

from typing import Any

import numpy as np

from mouse_cli.plots import AFTER, BEFORE, Plot
from mouse_cli.report.reading import Part

_MOST, _ROW = 8, 4  # shapes, and how many stand beside each other
_SIZE = 0.15  # of the structure: the largest displacement
_GAP = 1.2  # from one drawing to the next, in sizes of a drawing
_NARROW = 0.4  # of the larger side of a drawing: the least room, for its label
_THIN = 1e-3  # of the largest extent, below which a direction is not seen
_VIEW = np.array([[0.866, -0.866, 0.0], [0.4, 0.4, 1.0]])  # isometric, z up


def draw(document: Part, axes: Any) -> bool:
    """Each mode beside the undeformed structure in grey."""
    geometry = document.part("geometry")
    shapes = geometry.parts("shapes")[:_MOST]
    at = _coordinates(geometry.rows("positions"))
    if not shapes or not len(at):
        return False
    lines = [[int(i) for i in line if i is not None] for line in geometry.rows("lines")]
    scale = _SIZE * (np.ptp(at, axis=0).max() or 1.0)
    drawn = np.array([at, *(at + scale * _coordinates(shape.rows("displacements")) for shape in shapes)])
    still, *moved = drawn @ _view(drawn).T
    low, high = (end([still, *moved], axis=(0, 1)) for end in (np.min, np.max))
    step = _GAP * np.maximum(high - low, _NARROW * np.max(high - low))
    for k, (shape, points) in enumerate(zip(shapes, moved, strict=True)):
        corner = step * [k % _ROW, -(k // _ROW)]
        _drawn(axes, still + corner, lines, BEFORE, 0.6)
        _drawn(axes, points + corner, lines, AFTER, 1.1)
        axes.text(*low + corner, f"mode {shape.label('mode')}, {shape.number('hz') or 0:.4g} Hz", fontsize=7, va="top")
    axes.set_aspect("equal")
    axes.set_axis_off()
    return True


def _view(drawn: np.ndarray) -> np.ndarray:
    """Directions (2, 3) in which what is `drawn` (d, k, 3) is seen: its plane where it stays in one, else an isometric view."""
    extent = np.ptp(drawn.reshape(-1, 3), axis=0)
    return _VIEW if extent.min() > _THIN * extent.max() else np.delete(np.eye(3), int(np.argmin(extent)), axis=0)


def _drawn(axes: Any, points: np.ndarray, lines: list[list[int]], colour: str, width: float) -> None:
    """points (k, 2); lines between them, or dots where there are none."""
    if not lines:
        axes.plot(*points.T, ".", color=colour, markersize=3)
        return
    gap = np.full(2, np.nan)
    path = np.array([each for i, j in lines for each in (points[i], points[j], gap)])
    axes.plot(*path.T, color=colour, linewidth=width)


def _coordinates(rows: list[list[float | None]]) -> np.ndarray:
    """Coordinates (k, 3)."""
    return np.array([[0.0 if x is None else x for x in row] for row in rows], dtype=float).reshape(-1, 3)


PLOT = Plot("answer-shapes", 60, "Mode shapes of the revised model", draw, (Part,))
