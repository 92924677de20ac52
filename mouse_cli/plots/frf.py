"""Figures of measured frequency response functions and models of them."""

import warnings
from typing import Any

import numpy as np

from mouse_cli.model.diagnosis import Diagnosis
from mouse_cli.model.frf_fit import FrfFit
from mouse_cli.model.result import Result
from mouse_cli.plots import Plot, labelled
from mouse_cli.plots._functions import colours, fitted_height, overlay, unbroken, worst


def frf_overlay(found: Result | Diagnosis, axes: Any) -> bool:
    """One function that was fitted: of a run the one met worst in the end, of a diagnosis the one that lacks the cause most."""
    if not found.frf:
        return False
    overlay(*worst(found.frf, 0 if isinstance(found, Diagnosis) else -1), found.problem.units, axes)
    return True


_LINES, _LEAST = 40, 0.04  # to either side, and the share of the frequency that is shown at least
_MANY = 3  # times as many lines as are shown, for a detail to be one


def frf_detail(found: Result | Diagnosis, axes: Any) -> bool:
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


def frf_residual(found: Result, axes: Any) -> bool:
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


_FLOOR = 0.2  # what lies below is no different from noise


def frf_misfit(found: Result | Diagnosis, axes: Any) -> bool:
    """Root mean square over all functions of |model - test| over its standard deviation, line by line; 1 is noise alone."""
    if not found.frf:
        return False
    for k, fit in enumerate(found.frf):
        hz = fit.test.frequency_hz
        for model, colour in zip(fit.models, colours(fit), strict=False):
            axes.semilogy(unbroken(hz), _spectrum(fit, model.H), color=colour, lw=0.9, label=None if k else model.name)
    axes.axhline(1.0, color="black", lw=0.8, ls=":", label="noise alone")
    axes.set_ylim(bottom=_FLOOR)
    return labelled(
        axes,
        "frequency, Hz",
        "rms |model - test| over its\nnoise" + (", as assumed" if found.frf[0].assumed else ""),
        3,
    )


def _spectrum(fit: FrfFit, model: np.ndarray) -> np.ndarray:
    off = fit.off_sd(model)
    known = np.isfinite(off).sum(axis=(1, 2))
    return np.sqrt(np.divide(np.nansum(off**2, axis=(1, 2)), known, out=np.full(len(off), np.nan), where=known > 0))


def frf_held_out(found: Result | Diagnosis, axes: Any) -> bool:
    """One function that no fit has seen: the one that the last model predicts worst."""
    if not found.held_frf:
        return False
    overlay(*worst(found.held_frf, -1), found.problem.units, axes)
    return True


PLOTS = (
    Plot("frf-overlay", 60, "A function, measured and modelled", frf_overlay, (Result, Diagnosis)),
    Plot("frf-detail", 61, "The same where the first model differs most", frf_detail, (Result, Diagnosis)),
    Plot("frf-residual", 62, "Difference of models and measurement", frf_residual, (Result,)),
    Plot("frf-misfit", 63, "Difference of models and measurement over noise", frf_misfit, (Result, Diagnosis)),
    Plot("frf-held-out", 66, "Held-out FRF, measured and predicted", frf_held_out, (Result, Diagnosis)),
)
