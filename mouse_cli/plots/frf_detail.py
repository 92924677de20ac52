"""That function where the first model differs most from what was measured, beyond its noise."""

from typing import Any

import numpy as np

from mouse_cli.model.diagnosis import Diagnosis
from mouse_cli.model.result import Result
from mouse_cli.plots import Plot
from mouse_cli.plots._functions import fitted_height, overlay, worst

_LINES, _LEAST = 40, 0.04  # to either side, and the share of the frequency that is shown at least
_MANY = 3  # times as many lines as are shown, for a detail to be one


def draw(found: Result | Diagnosis, axes: Any) -> bool:
    """Magnitudes in dB over frequency, with bands; nothing for few lines."""
    if not found.frf:
        return False
    fit, o, i = worst(found.frf, 0 if isinstance(found, Diagnosis) else -1)
    hz = fit.test.frequency_hz
    off = np.nan_to_num(fit.off_sd(fit.models[0].H)[:, o, i])
    if len(hz) < _MANY * 2 * _LINES or not off.any():
        return False
    at = int(off.argmax())
    low = min(hz[max(at - _LINES, 0)], (1 - _LEAST) * hz[at])
    high = max(hz[min(at + _LINES, len(hz) - 1)], (1 + _LEAST) * hz[at])
    overlay(fit, o, i, found.problem.units, axes)
    axes.set_xlim(max(low, hz[0]), min(high, hz[-1]))
    fitted_height(fit, o, i, (hz >= low) & (hz <= high), axes)
    return True


PLOT = Plot("frf-detail", 61, "The same where the first model differs most", draw, (Result, Diagnosis))
