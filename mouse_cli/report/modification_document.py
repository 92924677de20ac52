"""A modified structure as one JSON document, schema mouse.modification/1."""

from typing import Any

import numpy as np

from mouse_cli.model.modified import Modified, ModifiedFunctions, Need, Place, Swept
from mouse_cli.model.result import Forecast
from mouse_cli.report.coupling_document import connection, functions
from mouse_cli.report.json_values import dof_name, fields

SCHEMA = "mouse.modification/1"


def document(found: Modified) -> dict[str, Any]:
    """`found` in plain Python values; covariances and shapes have a row or entry for each mode after the changes, in their
    order."""
    modification, after = found.modification, found.after
    return {
        "schema": SCHEMA,
        "title": modification.title.strip(),
        "source": modification.path,
        "model": modification.problem.source.path,
        "changes": [connection(one, names=modification.part.places) for one in found.connections],
        "before": _before(found.before),
        "modes": _modes(found),
        "covariance_hz2": after.root_hz @ after.root_hz.T,
        "dofs": [dof_name(label) for label in after.problem.structure.labels],
        "damped": None if after.damped is None else _damped(found),
        "targets": [_need(need) for need in found.needs],
        "sweeps": [_swept(each) for each in found.swept],
        "functions": None if found.functions is None else _functions(found.functions),
        "warnings": [f"{d.code}: {d.message}" for d in found.warnings],
    }


def _before(before: Forecast) -> list[dict[str, Any]]:
    values = zip(before.frequencies_hz, before.sd_hz, strict=True)
    return [{"mode": i, "hz": _elastic(before, i, hz), "sd_hz": sd} for i, (hz, sd) in enumerate(values, 1)]


def _elastic(forecast: Forecast, mode: int, hz: float) -> float:
    return float(hz) if mode > forecast.rigid_modes else 0.0


def _modes(found: Modified) -> list[dict[str, Any]]:
    after, shifts = found.after, found.shifts
    return [
        {
            "mode": i + 1,
            "hz": _elastic(after, i + 1, after.frequencies_hz[i]),
            "sd_hz": after.sd_hz[i],
            "from_mode": int(shifts.partner[i]) + 1 if shifts.partner[i] >= 0 else None,
            "mac": shifts.mac[i],
            "shift_hz": shifts.shift_hz[i],
            "shift_sd_hz": shifts.sd_hz[i],
            "shape": after.shapes[:, i],
            "shape_sd": after.shape_sd[:, i],
        }
        for i in range(len(after.frequencies_hz))
    ]


def _damped(found: Modified) -> list[dict[str, Any]]:
    damped = found.after.damped
    values = zip(damped.frequencies_hz, damped.damping, damped.damping_sd, damped.complexity, strict=True)
    return [{"hz": hz, "damping": ratio, "damping_sd": sd, "complexity": c} for hz, ratio, sd, c in values]


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
    tuned = {} if np.isnan(place.mass_ratio) else {
        **fields(place, "mass_ratio", "tuned_hz", "damping_ratio", "peak"),
    }  # fmt: skip
    return {"place": place.name, "hz": place.hz, **tuned}


def _functions(found: ModifiedFunctions) -> dict[str, Any]:
    return {
        "before": functions(found.before),
        "after": functions(found.after),
        "sd_log": np.moveaxis(found.sd_log, 0, -1),
        "peaks_before": [vars(peak) for peak in found.peaks_before],
        "peaks": [vars(peak) for peak in found.peaks],
    }
