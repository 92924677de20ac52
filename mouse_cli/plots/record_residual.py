"""What simulations leave of the stretch of a record that no fit has seen, over frequency, beside the noise of its channel."""

from typing import Any

import numpy as np

from mouse_cli.model.record_diagnosis import RecordDiagnosis
from mouse_cli.model.record_update import RecordUpdate
from mouse_cli.plots import Plot
from mouse_cli.plots._records import legend, models, quantity


def draw(found: RecordDiagnosis | RecordUpdate, axes: Any) -> bool:
    """rms of each line of the spectra of measured, and of measured less simulated."""
    shown = found.trace
    if shown is None or not shown.simulated:
        return False
    t = len(shown.measured)
    hz = np.fft.rfftfreq(t, shown.time_s[1] - shown.time_s[0])[1:]
    axes.semilogy(hz, lines(shown.measured), color="black", linewidth=1.2, label="measured")
    for name, colour, values in models(found):
        axes.semilogy(hz, lines(shown.measured - values), color=colour, linewidth=1.0, label=f"residual, {name}")
    axes.axhline(shown.sd * np.sqrt(2 / t), color="black", linewidth=0.8, linestyle=":", label="noise")
    axes.set_xlabel("frequency, Hz")
    axes.set_ylabel(f"rms of a line of\n{quantity(shown)}")
    legend(axes)
    return True


def lines(x: np.ndarray) -> np.ndarray:
    """rms of the lines 1 to t // 2 of `x` (t,) under a Hann window; the sum of their squares is the variance of x.

    White noise of standard deviation sd has sd sqrt(2/t) in each.
    """
    window = np.hanning(len(x) + 1)[:-1]
    return np.abs(np.fft.rfft(window * (x - x.mean())))[1:] * np.sqrt(2 / (len(x) * (window**2).sum()))


PLOT = Plot("record-residual", 56, "Residual of the held-out record", draw, (RecordDiagnosis, RecordUpdate))
