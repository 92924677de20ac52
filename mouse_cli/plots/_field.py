"""What both figures of a field without a name share."""

from typing import Any

import numpy as np

from mouse_cli.plots import AFTER

TITLE = "Physics without a name along the structure"
UNITS = {
    "stiffness": "change of stiffness, per cent",
    "mass": "change of mass, per cent",
    "bed": "bed stiffness, EI/L^4",
    "axial": "axial force, EI/L^2",
    "force": "motion of the spring",
    "law": "stiffness over the static stiffness there",
}


def band(axes: Any, at: np.ndarray, value: np.ndarray, sd: np.ndarray, along: str, kind: str) -> bool:
    """Values (j,) at coordinates (j,) with their band of two standard deviations; whether there are enough to draw."""
    known = np.isfinite(value) & np.isfinite(sd)
    if known.sum() < 2:
        return False
    by = 100.0 if UNITS.get(kind, "").endswith("per cent") else 1.0
    order = np.flatnonzero(known)[np.argsort(at[known], kind="stable")]
    at, value, sd = at[order], by * value[order], by * sd[order]
    axes.fill_between(at, value - 2 * sd, value + 2 * sd, color=AFTER, alpha=0.2, linewidth=0, label="2 sd")
    axes.plot(at, value, color=AFTER, linewidth=1.4, marker=".", markersize=4, label="value")
    axes.axhline(0, color="black", linewidth=0.8)
    axes.set_xlabel(along)
    axes.set_ylabel(UNITS.get(kind, "value"))
    axes.legend()
    return True
