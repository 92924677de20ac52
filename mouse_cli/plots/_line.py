"""Places in a row, or not: what a structure of one line shows along its length, others show as a list."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from mouse_cli.model.diagnosis import Site

_THIN = 0.05  # of the length: how far places may lie off the line


def along(sites: Sequence[Site]) -> tuple[np.ndarray, str] | None:
    """Coordinate (j,) along the longest direction and its name; None where the places are not in one line."""
    if len(sites) < 2 or any(site.position is None for site in sites):
        return None
    at = np.array([site.position for site in sites], dtype=float)
    extent = np.ptp(at, axis=0)
    axis = int(np.argmax(extent))
    return None if np.delete(extent, axis).max() > _THIN * extent[axis] else (at[:, axis], "xyz"[axis])


def lying(axes: Any, labels: list[str], values: list[float], colour: str) -> None:
    """Bars under each other, the first on top."""
    axes.barh(range(len(labels)), values, color=colour, height=0.7)
    axes.set_yticks(range(len(labels)), labels, fontsize=7)
    axes.invert_yaxis()
    axes.grid(axis="y", visible=False)
