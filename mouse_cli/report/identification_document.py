"""An identification as one JSON document, schema mouse.identification/1."""

from dataclasses import asdict
from typing import Any

import numpy as np

from mouse_cli.model.identification import Identification
from mouse_cli.report.json_values import coded, dof_name, fields, rows

SCHEMA = "mouse.identification/1"


def document(found: Identification) -> dict[str, Any]:
    """`found` in plain Python values; shapes row by row in the order of `sensors`, one column a mode; damping as a ratio."""
    modes = found.modes
    return {
        "schema": SCHEMA,
        **fields(found, "title", "sources", "method", "noise", "band_hz"),
        "sensors": [dof_name(name) for name in found.sensors],
        "misfit": found.misfit,
        "modes": _modes(found),
        "covariance": modes.covariance,
        "shapes_real": modes.shapes.real,
        "shapes_imaginary": modes.shapes.imag,
        "shape_sd": modes.shape_sd,
        "imaginary_sd": modes.imaginary_sd,
        "rejected": [asdict(each) for each in found.rejected],
        "diagram": fields(found.diagram, "order", "frequency_hz", "damping", "stable"),
        "details": found.details,
        "trusted": found.exit_code == 0,
        "doubts": coded(found.doubts),
        "warnings": coded(found.remarks),
    }


def _modes(found: Identification) -> list[dict[str, Any]]:
    modes, each = (
        found.modes,
        ("frequency_hz", "frequency_sd_hz", "damping", "damping_sd", "mpc", "scale", "stable_orders"),
    )
    lines = np.where(np.isfinite(modes.error), modes.lines, np.nan)
    return rows(**fields(modes, *each), lines_in_bandwidth=lines, fit_error=modes.error)
