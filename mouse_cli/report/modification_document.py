"""A modified structure as one JSON document, schema mouse.modification/1."""

from typing import Any

import numpy as np

from mouse_cli.model.modified import Modified, ModifiedFunctions, Need, Place, Swept
from mouse_cli.model.result import Forecast
from mouse_cli.report.coupling_document import connection, functions
from mouse_cli.report.json_values import coded, dof_name, fields, rows
from mouse_cli.report.modes_document import damping

SCHEMA = "mouse.modification/1"


def document(found: Modified) -> dict[str, Any]:
    """`found` in plain Python values; covariances and shapes have a row or entry for each mode after the changes, in their
    order."""
    modification, before, after = found.modification, found.before, found.after
    return {
        "schema": SCHEMA,
        "title": modification.title.strip(),
        "source": modification.path,
        "model": modification.problem.source.path,
        "changes": [connection(one, names=modification.part.places) for one in found.connections],
        "before": rows(mode=range(1, len(before.frequencies_hz) + 1), hz=_elastic(before), sd_hz=before.sd_hz),
        "modes": _modes(found),
        "covariance_hz2": after.root_hz @ after.root_hz.T,
        "dofs": [dof_name(label) for label in after.problem.structure.labels],
        "damped": None if after.damped is None else rows(**damping(after.damped)),
        "targets": [_need(need) for need in found.needs],
        "sweeps": [_swept(each) for each in found.swept],
        "functions": None if found.functions is None else _functions(found.functions),
        "warnings": coded(found.warnings),
    }


def _elastic(forecast: Forecast) -> np.ndarray:
    """Frequencies, 0 of rigid-body modes."""
    count = len(forecast.frequencies_hz)
    return np.where(np.arange(count) < forecast.rigid_modes, 0.0, forecast.frequencies_hz)


def _modes(found: Modified) -> list[dict[str, Any]]:
    after, shifts = found.after, found.shifts
    return rows(
        mode=range(1, len(after.frequencies_hz) + 1),
        hz=_elastic(after),
        sd_hz=after.sd_hz,
        from_mode=[j + 1 if j >= 0 else None for j in shifts.partner.tolist()],
        mac=shifts.mac,
        shift_hz=shifts.shift_hz,
        shift_sd_hz=shifts.sd_hz,
        shape=after.shapes.T,
        shape_sd=after.shape_sd.T,
    )


def _need(need: Need) -> dict[str, Any]:
    target = need.target
    return {
        **fields(target, "mode", "side", "hz"),
        "by": target.means,
        **fields(need, "place", "value", "sd", "sure", "reached_hz", "limit_hz", "likeness", "reason"),
    }


def _swept(each: Swept) -> dict[str, Any]:
    sweep = each.sweep
    places = [_place(place) for place in each.places]
    return {"by": sweep.means, "size": sweep.size, "mode": sweep.mode, "before_hz": each.before_hz, "places": places}


def _place(place: Place) -> dict[str, Any]:
    tuned = () if np.isnan(place.mass_ratio) else ("mass_ratio", "tuned_hz", "damping_ratio", "peak")
    return {"place": place.name, **fields(place, "hz", *tuned)}


def _functions(found: ModifiedFunctions) -> dict[str, Any]:
    return {
        "before": functions(found.before),
        "after": functions(found.after),
        "sd_log": np.moveaxis(found.sd_log, 0, -1),
        "peaks_before": [vars(peak) for peak in found.peaks_before],
        "peaks": [vars(peak) for peak in found.peaks],
    }
