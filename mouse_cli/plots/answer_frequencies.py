"""Of an answer in JSON: what the models miss of the measured frequencies."""

from typing import Any

import numpy as np

from mouse_cli.plots import Plot
from mouse_cli.plots._answers import MOST, update, values
from mouse_cli.plots._pairs import pairs
from mouse_cli.report.reading import Part


def draw(document: Part, axes: Any) -> bool:
    """Two bars a mode, in per cent of the measured frequency, with the sd of its measurement."""
    found = update(document)
    modes = [m for m in found.parts("modes") if m.number("test_hz")][:MOST] if found else []
    if not modes:
        return False
    measured = values(modes, "test_hz")
    errors = [100 * (values(modes, key) / measured - 1) for key in ("prior_hz", "revised_hz")]
    sd = np.nan_to_num(100 * values(modes, "test_sd_hz") / measured)
    pairs(axes, [f"mode {m.label('mode')}" for m in modes], errors, sd, ("prior", "revised"))
    return True


PLOT = Plot("answer-frequencies", 10, "What the models miss of the measured frequencies", draw, (Part,))
