"""A forecast as one JSON document, schema mouse.modes/1."""

from typing import Any

from mouse_cli import __version__
from mouse_cli.dynamics.frequency import eigenvalue
from mouse_cli.model.result import Forecast
from mouse_cli.report.json_values import dof_name, plain

SCHEMA = "mouse.modes/1"


def document(forecast: Forecast) -> dict[str, Any]:
    """`forecast` in plain Python values; shape and shape_sd are in the order of dofs."""
    problem = forecast.problem
    modes = zip(forecast.frequencies_hz, forecast.sd_hz, forecast.shapes.T, forecast.shape_sd.T, strict=True)
    return plain(
        {
            "schema": SCHEMA,
            "version": __version__,
            "title": problem.title.strip(),
            "source": problem.source.path,
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
            "warnings": [f"{d.code}: {d.message}" for d in problem.warnings],
        }
    )
