"""Directions of *TRANSFORM at a node."""

import numpy as np


def local_axes(kind: str, points: np.ndarray, at: np.ndarray) -> np.ndarray | None:
    """Axes (3, 3), in columns. R: `points` (6,) are one on the first axis and one in the plane of the first two; C: two on the axis
    of a cylinder, whose radius at the node is the first direction. None where they give none.

    >>> local_axes("C", np.array([0.0, 0, 0, 0, 0, 1]), np.array([0.0, 2, 5])).T.round(9).tolist()
    [[0.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]
    """
    a, b = points[:3], points[3:]
    if kind == "C":
        z = _unit(b - a)
        x = None if z is None else _unit((at - a) - ((at - a) @ z) * z)
    else:
        x = _unit(a)
        z = None if x is None else _unit(np.cross(a, b))
    return None if x is None or z is None else np.column_stack([x, np.cross(z, x), z])


def _unit(v: np.ndarray) -> np.ndarray | None:
    length = float(np.linalg.norm(v))
    return v / length if length > 1e-12 else None
