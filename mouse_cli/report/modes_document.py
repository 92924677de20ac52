"""A forecast as one JSON document, schema mouse.modes/1."""

from typing import Any

import numpy as np

from mouse_cli.dynamics.frequency import eigenvalue
from mouse_cli.model.result import DampedModes, Forecast
from mouse_cli.report.geometry_document import MOST_MODES, Moved, geometry
from mouse_cli.report.json_values import coded, dof_name, fields, heading, rows

SCHEMA = "mouse.modes/1"


def document(forecast: Forecast) -> dict[str, Any]:
    """`forecast` in plain Python values; shape and shape_sd are in the order of dofs."""
    problem = forecast.problem
    modes = zip(forecast.frequencies_hz, forecast.sd_hz, forecast.shapes.T, forecast.shape_sd.T, strict=True)
    return {
        **heading(SCHEMA, problem),
        "rigid_modes": forecast.rigid_modes,
        "dofs": [dof_name(label) for label in problem.structure.labels],
        "modes": [
            {
                "mode": i,
                "eigenvalue": eigenvalue(hz) if i > forecast.rigid_modes else 0.0,
                "hz": hz if i > forecast.rigid_modes else 0.0,
                "sd_hz": sd,
                "shape": shape,
                "shape_sd": shape_sd,
            }
            for i, (hz, sd, shape, shape_sd) in enumerate(modes, 1)
        ],
        "geometry": geometry(problem, _moved(forecast)),
        **({} if forecast.damped is None else {"damped": _damped(forecast.damped)}),
        "warnings": coded(problem.warnings),
    }


def _moved(forecast: Forecast) -> list[Moved]:
    """The lowest elastic modes, for drawings."""
    none, first = np.zeros(0), forecast.rigid_modes
    chosen = range(first, min(first + MOST_MODES, len(forecast.frequencies_hz)))
    return [Moved(k + 1, float(forecast.frequencies_hz[k]), forecast.shapes[:, k], none, none) for k in chosen]


def _damped(found: DampedModes) -> list[dict[str, Any]]:
    """One entry a complex mode; its shape as real and imaginary parts, in the order of dofs."""
    shapes = [[shape.real, shape.imag] for shape in found.shapes.T]
    return rows(**damping(found), shape=shapes)


def damping(found: DampedModes) -> dict[str, Any]:
    """Columns of complex modes."""
    return {"hz": found.frequencies_hz, **fields(found, "damping", "damping_sd", "complexity")}
