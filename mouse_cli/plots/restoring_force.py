"""The restoring-force surface at the place of a law: the force that the record asks for, over motion and velocity."""

import re
from typing import Any

import numpy as np

from mouse_cli.model.record_diagnosis import RecordDiagnosis
from mouse_cli.model.record_update import RecordUpdate
from mouse_cli.model.units import Units
from mouse_cli.plots import AFTER, BEFORE, Plot

_POINTS = 4000
_TURNS = re.compile(r"\dR[XYZ]\b")


def draw(found: RecordDiagnosis | RecordUpdate, axes: Any) -> bool:
    """Force over the motion, or over the velocity where that tells more of it; the fitted law on top (Masri and Caughey)."""
    shown = found.surface
    if shown is None:
        return False
    own = slice(None, None, max(1, len(shown.x) // _POINTS))
    along, name = (
        (shown.v, "velocity") if _explains(shown.v, shown.law) > _explains(shown.x, shown.law) else (shown.x, "motion")
    )
    axes.plot(along[own], shown.force[own], ".", color=BEFORE, markersize=1.5, label="implied by the recording")
    axes.plot(along[own], shown.law[own], ".", color=AFTER, markersize=1.5, label=f"{shown.title}, fitted")
    turns, units = _TURNS.search(shown.site), found.problem.units
    rate = "/s" if name == "velocity" else ""
    axes.set_xlabel(f"{name} {shown.site}{_in(units, f'rad{rate}' if turns else f'm{rate}')}")
    axes.set_ylabel(f"{'moment' if turns else 'force'}{_in(units, 'N m' if turns else 'N')}")
    axes.legend(markerscale=6, loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=2, borderaxespad=0.1)
    return True


def _in(units: Units, unit: str) -> str:
    """The unit behind a name, where the deck says its units."""
    return f", {units.of(unit)}" if units.declared else ""


def _explains(along: np.ndarray, force: np.ndarray, bins: int = 40) -> float:
    """Share of the variance of `force` that a function of `along` explains."""
    at = np.clip(((along - along.min()) / max(np.ptp(along), 1e-300) * bins).astype(int), 0, bins - 1)
    count = np.maximum(np.bincount(at, minlength=bins), 1)
    mean = np.bincount(at, force, minlength=bins) / count
    return 1 - float(((force - mean[at]) ** 2).mean() / max(force.var(), 1e-300))


PLOT = Plot("restoring-force", 35, "Restoring force at the site of the law", draw, (RecordDiagnosis, RecordUpdate))
