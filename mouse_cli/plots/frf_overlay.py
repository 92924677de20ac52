"""One function that was fitted: of a run the one met worst in the end, of a diagnosis the one that lacks the cause most."""

from typing import Any

from mouse_cli.model.diagnosis import Diagnosis
from mouse_cli.model.result import Result
from mouse_cli.plots import Plot
from mouse_cli.plots._functions import overlay, worst


def draw(found: Result | Diagnosis, axes: Any) -> bool:
    """Magnitudes in dB over frequency, with bands."""
    if not found.frf:
        return False
    overlay(*worst(found.frf, 0 if isinstance(found, Diagnosis) else -1), found.problem.units, axes)
    return True


PLOT = Plot("frf-overlay", 60, "A function, measured and modelled", draw, (Result, Diagnosis))
