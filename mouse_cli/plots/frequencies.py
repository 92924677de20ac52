"""Error of the fitted frequencies: the model as it is, and extended."""

from typing import Any

import numpy as np

from mouse_cli.dynamics.frequency import frequency_hz
from mouse_cli.model.diagnosis import Diagnosis
from mouse_cli.plots import Plot
from mouse_cli.plots._pairs import names, pairs


def draw(found: Diagnosis, axes: Any) -> bool:
    """Two bars a mode, in per cent of the measured frequency, with the sd of its measurement."""
    test, after = found.problem.test, found.extended_result
    if test is None or not np.isfinite(test.frequency_hz).any():
        return False
    errors = [_error(found.result.revised, test.frequency_hz)]
    if after is not None:
        errors.append(_error(after.revised, test.frequency_hz))
    sd = 100 * test.frequency_sd_hz / test.frequency_hz
    pairs(axes, [f"mode {number}" for number in test.number], errors, sd, names(found))
    return True


def _error(model: Any, measured: np.ndarray) -> np.ndarray:
    return 100 * (frequency_hz(model.eigenvalues[model.modes]) / measured - 1)


PLOT = Plot("frequencies", 40, "Frequencies that were fitted", draw)
