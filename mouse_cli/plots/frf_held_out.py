"""One function that no fit has seen: the one that the last model predicts worst."""

from typing import Any

from mouse_cli.model.diagnosis import Diagnosis
from mouse_cli.model.result import Result
from mouse_cli.plots import Plot
from mouse_cli.plots._functions import overlay, worst


def draw(found: Result | Diagnosis, axes: Any) -> bool:
    """Magnitudes in dB over frequency, with bands."""
    if not found.held_frf:
        return False
    overlay(*worst(found.held_frf, -1), found.problem.units, axes)
    return True


PLOT = Plot("frf-held-out", 66, "Held-out FRF, measured and predicted", draw, (Result, Diagnosis))
