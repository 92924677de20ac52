"""The restoring-force surface at the place of the cause: the force that the record asks for, over motion and velocity."""

from typing import Any

import numpy as np

from mouse_cli.model.diagnosis import Diagnosis
from mouse_cli.model.record_diagnosis import RecordDiagnosis
from mouse_cli.plots import AFTER, BEFORE, Plot

_POINTS = 4000


def draw(found: Diagnosis, axes: Any) -> bool:
    """Force over the motion, or over the velocity where that tells more of it; the fitted law on top (Masri and Caughey)."""
    if not isinstance(found, RecordDiagnosis) or found.surface is None:
        return False
    shown = found.surface
    own = slice(None, None, max(1, len(shown.x) // _POINTS))
    along, name = (
        (shown.v, "velocity") if _explains(shown.v, shown.law) > _explains(shown.x, shown.law) else (shown.x, "motion")
    )
    axes.plot(along[own], shown.force[own], ".", color=BEFORE, markersize=1.5, label="asked for by the record")
    axes.plot(along[own], shown.law[own], ".", color=AFTER, markersize=1.5, label=f"{found.best.physics}, fitted")
    axes.set_xlabel(f"{name} {shown.site}")
    axes.set_ylabel("force")
    axes.legend(markerscale=6)
    return True


def _explains(along: np.ndarray, force: np.ndarray, bins: int = 40) -> float:
    """Share of the variance of `force` that a function of `along` explains."""
    at = np.clip(((along - along.min()) / max(np.ptp(along), 1e-300) * bins).astype(int), 0, bins - 1)
    count = np.maximum(np.bincount(at, minlength=bins), 1)
    mean = np.bincount(at, force, minlength=bins) / count
    return 1 - float(((force - mean[at]) ** 2).mean() / max(force.var(), 1e-300))


PLOT = Plot("restoring-force", 35, "Restoring force at the place of the cause", draw)
