"""Where along the frequencies models and measurement differ."""

import warnings
from typing import Any

import numpy as np

from mouse_cli.model.result import Result
from mouse_cli.plots import Plot
from mouse_cli.plots._functions import colours, unbroken


def draw(found: Result, axes: Any) -> bool:
    """Median over all functions of |20 log10 of model / test|, line by line; ticks where lines were fitted."""
    if not found.frf:
        return False
    for k, fit in enumerate(found.frf):
        hz = fit.test.frequency_hz
        for model, colour in zip(fit.models, colours(fit), strict=False):
            with warnings.catch_warnings():
                warnings.simplefilter("ignore", RuntimeWarning)  # lines at which nothing was measured
                level = np.nanmedian(np.abs(fit.off_db(model.H)), axis=(1, 2))
            axes.plot(unbroken(hz), level, color=colour, lw=0.9, label=None if k else model.name)
        axes.plot(hz[fit.lines], np.zeros(len(fit.lines)), "|", color="0.4", ms=5, label=None if k else "fitted lines")
    axes.set_xlabel("frequency, Hz")
    axes.set_ylabel("median |model / test|, dB")
    axes.set_ylim(bottom=0.0)
    axes.legend(loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=3, borderaxespad=0.1)
    return True


PLOT = Plot("frf-residual", 62, "Difference of models and measurement", draw, (Result,))
