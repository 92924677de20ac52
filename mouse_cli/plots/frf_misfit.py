"""What models leave of the measured functions, over their noise."""

from typing import Any

import numpy as np

from mouse_cli.model.diagnosis import Diagnosis
from mouse_cli.model.frf_fit import FrfFit
from mouse_cli.model.result import Result
from mouse_cli.plots import Plot
from mouse_cli.plots._functions import colours, unbroken

_FLOOR = 0.2  # what lies below is no different from noise


def draw(found: Result | Diagnosis, axes: Any) -> bool:
    """Root mean square over all functions of |model - test| over its standard deviation, line by line; 1 is noise alone."""
    if not found.frf:
        return False
    for k, fit in enumerate(found.frf):
        hz = fit.test.frequency_hz
        for model, colour in zip(fit.models, colours(fit), strict=False):
            axes.semilogy(unbroken(hz), _spectrum(fit, model.H), color=colour, lw=0.9, label=None if k else model.name)
    axes.axhline(1.0, color="black", lw=0.8, ls=":", label="noise alone")
    axes.set_ylim(bottom=_FLOOR)
    axes.set_xlabel("frequency, Hz")
    axes.set_ylabel("rms |model - test| over its\nnoise" + (", as assumed" if found.frf[0].assumed else ""))
    axes.legend(loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=3, borderaxespad=0.1)
    return True


def _spectrum(fit: FrfFit, model: np.ndarray) -> np.ndarray:
    off = fit.off_sd(model)
    known = np.isfinite(off).sum(axis=(1, 2))
    return np.sqrt(np.divide(np.nansum(off**2, axis=(1, 2)), known, out=np.full(len(off), np.nan), where=known > 0))


PLOT = Plot("frf-misfit", 63, "Difference of models and measurement over noise", draw, (Result, Diagnosis))
