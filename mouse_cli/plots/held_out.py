"""Error of frequencies that no fit has seen: the model as it is, and extended."""

from typing import Any

import numpy as np

from mouse_cli.model.diagnosis import Diagnosis
from mouse_cli.plots import Plot
from mouse_cli.plots._pairs import names, pairs
from mouse_cli.report.sections._diagnosis_wording import predicting


def draw(found: Diagnosis, axes: Any) -> bool:
    """Two bars a frequency, in per cent of what was measured, with the sd of the prediction."""
    held = found.held_out
    if held is None or not np.isfinite(held.measured_hz).any():
        return False
    scores = [held.baseline] if held.revised is None else [held.baseline, held.revised]
    errors = [100 * (score.frequencies_hz / held.measured_hz - 1) for score in scores]
    pairs(
        axes, list(held.labels), errors, 100 * scores[-1].sd_hz / held.measured_hz, (names(found)[0], predicting(found))
    )
    return True


PLOT = Plot("held-out", 50, "Held-out frequencies", draw)
