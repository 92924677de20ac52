"""An identification as one JSON document, schema mouse.identification/1."""

from dataclasses import asdict
from typing import Any

import numpy as np

from mouse_cli.model.identification import Identification
from mouse_cli.report.json_values import dof_name, fields

SCHEMA = "mouse.identification/1"


def document(found: Identification) -> dict[str, Any]:
    """`found` in plain Python values; shapes row by row in the order of `sensors`, one column a mode; damping as a ratio."""
    modes = found.modes
    return {
        "schema": SCHEMA,
        **fields(found, "title", "sources", "method", "noise", "band_hz"),
        "sensors": [dof_name(name) for name in found.sensors],
        "misfit": found.misfit,
        "modes": [_mode(found, r) for r in range(modes.m)],
        "covariance": modes.covariance,
        "shapes_real": modes.shapes.real,
        "shapes_imaginary": modes.shapes.imag,
        "shape_sd": modes.shape_sd,
        "imaginary_sd": modes.imaginary_sd,
        "rejected": [asdict(each) for each in found.rejected],
        "diagram": fields(found.diagram, "order", "frequency_hz", "damping", "stable"),
        "details": found.details,
        "trusted": found.exit_code == 0,
        "doubts": [f"{d.code}: {d.message}" for d in found.doubts],
        "warnings": [f"{d.code}: {d.message}" for d in found.remarks],
    }


def _mode(found: Identification, r: int) -> dict[str, Any]:
    modes = found.modes
    return {
        "frequency_hz": modes.frequency_hz[r],
        "frequency_sd_hz": modes.frequency_sd_hz[r],
        "damping": modes.damping[r],
        "damping_sd": modes.damping_sd[r],
        "mpc": modes.mpc[r],
        "scale": modes.scale[r],
        "stable_orders": int(modes.stable_orders[r]),
        "lines_in_bandwidth": modes.lines[r] if np.isfinite(modes.error[r]) else None,
        "fit_error": modes.error[r],
    }
