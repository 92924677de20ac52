"""Where along the frequencies model and measurement differ, before and after."""

import warnings
from typing import Any

import numpy as np

from mouse_cli.model.result import Result
from mouse_cli.plots import AFTER, BEFORE, Plot


def draw(result: Result, axes: Any) -> bool:
    """Median over all functions of |20 log10 of model / test|, line by line; ticks where lines were fitted."""
    if not result.frf:
        return False
    for k, fit in enumerate(result.frf):
        hz = fit.test.frequency_hz
        for model, colour, label in ((fit.prior, BEFORE, "prior"), (fit.revised, AFTER, "revised")):
            with warnings.catch_warnings():
                warnings.simplefilter("ignore", RuntimeWarning)  # lines at which nothing was measured
                level = np.nanmedian(np.abs(fit.off_db(model)), axis=(1, 2))
            axes.plot(hz, level, color=colour, lw=0.9, label=None if k else label)
        axes.plot(hz[fit.lines], np.zeros(len(fit.lines)), "|", color="0.4", ms=5, label=None if k else "fitted")
    axes.set_xlabel("frequency, Hz")
    axes.set_ylabel("median difference, dB")
    axes.set_ylim(bottom=0.0)
    axes.legend(loc="best")
    return True


PLOT = Plot("frf-residual", 210, "Difference of model and measurement", draw, (Result,))
