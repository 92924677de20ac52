"""Figures of recordings: a held-out record, what simulations leave of it, the force of a law."""

import re
from collections.abc import Iterator
from typing import Any

import numpy as np

from mouse_cli.model.record_diagnosis import WITH_CAUSE, RecordDiagnosis, Trace
from mouse_cli.model.record_update import RecordUpdate
from mouse_cli.model.units import Units
from mouse_cli.plots import AFTER, BEFORE, Plot, labelled


def models(found: RecordDiagnosis | RecordUpdate) -> Iterator[tuple[str, str, np.ndarray]]:
    """Name, colour and simulated output (t,) of each model."""
    for name, values in found.trace.simulated.items():
        yield (found.after, AFTER, values) if name == WITH_CAUSE else (name, BEFORE, values)


def quantity(shown: Trace) -> str:
    """The output and its unit."""
    return f"{shown.title}{f', {shown.unit}' if shown.unit else ''}"


_POINTS = 4000
_TURNS = re.compile(r"\dR[XYZ]\b")


def restoring_force(found: RecordDiagnosis | RecordUpdate, axes: Any) -> bool:
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


_BINS = 40  # of the motion


def _explains(along: np.ndarray, force: np.ndarray) -> float:
    """Share of the variance of `force` that a function of `along` explains."""
    at = np.clip(((along - along.min()) / max(np.ptp(along), 1e-300) * _BINS).astype(int), 0, _BINS - 1)
    count = np.maximum(np.bincount(at, minlength=_BINS), 1)
    mean = np.bincount(at, force, minlength=_BINS) / count
    return 1 - float(((force - mean[at]) ** 2).mean() / max(force.var(), 1e-300))


def record_held_out(found: RecordDiagnosis | RecordUpdate, axes: Any) -> bool:
    """A stretch of a record that no fit has seen: measured, and simulated by both models. Lines over time."""
    shown = found.trace
    if shown is None:
        return False
    axes.plot(shown.time_s, shown.measured, color="black", linewidth=1.2, label="measured")
    for name, colour, values in models(found):
        axes.plot(shown.time_s, values, "--", color=colour, linewidth=1.0, label=f"simulated, {name}")
    return labelled(axes, "time, s", quantity(shown), 4)


def record_residual(found: RecordDiagnosis | RecordUpdate, axes: Any) -> bool:
    """rms of each line of the spectra of measured, and of measured less simulated."""
    shown = found.trace
    if shown is None or not shown.simulated:
        return False
    t = len(shown.measured)
    hz = np.fft.rfftfreq(t, shown.time_s[1] - shown.time_s[0])[1:]
    axes.semilogy(hz, lines(shown.measured), color="black", linewidth=1.2, label="measured")
    for name, colour, values in models(found):
        axes.semilogy(hz, lines(shown.measured - values), color=colour, linewidth=1.0, label=f"residual, {name}")
    axes.axhline(shown.sd * np.sqrt(2 / t), color="black", linewidth=0.8, linestyle=":", label="noise")
    return labelled(axes, "frequency, Hz", f"rms of a line of\n{quantity(shown)}", 4)


def lines(x: np.ndarray) -> np.ndarray:
    """rms of the lines 1 to t // 2 of `x` (t,) under a Hann window; the sum of their squares is the variance of x.

    White noise of standard deviation sd has sd sqrt(2/t) in each.
    """
    window = np.hanning(len(x) + 1)[:-1]
    return np.abs(np.fft.rfft(window * (x - x.mean())))[1:] * np.sqrt(2 / (len(x) * (window**2).sum()))


PLOTS = (
    Plot(
        "restoring-force",
        35,
        "Restoring force at the site of the law",
        restoring_force,
        (RecordDiagnosis, RecordUpdate),
    ),
    Plot("record-held-out", 55, "Held-out record", record_held_out, (RecordDiagnosis, RecordUpdate)),
    Plot("record-residual", 56, "Residual of the held-out record", record_residual, (RecordDiagnosis, RecordUpdate)),
)
