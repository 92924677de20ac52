"""The function that the revised model meets worst: measured, prior and revised, with the bands that the parameters leave."""

from typing import Any

import numpy as np

from mouse_cli.model.frf_fit import FrfFit
from mouse_cli.model.result import Result
from mouse_cli.observables.frf import names
from mouse_cli.plots import AFTER, BEFORE, Plot

_Z = 1.96  # half width of a band in standard deviations: 95 per cent
_WIDEST = 3.0  # of ln|H| beyond which a band is cut off


def draw(result: Result, axes: Any) -> bool:
    """Magnitudes in dB over frequency."""
    if not result.frf:
        return False
    fit = max(result.frf, key=lambda fit: np.nan_to_num(fit.median_db(fit.revised)))
    o, i = worst(fit)
    hz, outputs_inputs = fit.test.frequency_hz, names(fit.test)
    axes.plot(hz, _db(fit.test.H[:, o, i]), color="black", lw=0.8, label="measured")
    for model, sd, colour, label in (
        (fit.prior, fit.prior_sd, BEFORE, "prior"),
        (fit.revised, fit.revised_sd, AFTER, "revised"),
    ):
        level, half = _db(model[:, o, i]), _Z * 20 / np.log(10) * np.minimum(sd[:, o, i], _WIDEST)
        axes.plot(hz, level, color=colour, lw=0.9, label=label)
        if np.isfinite(half).any():
            axes.fill_between(hz, level - half, level + half, color=colour, alpha=0.2, lw=0)
    axes.set_xlabel("frequency, Hz")
    axes.set_ylabel(f"{fit.test.kind} {outputs_inputs[0][o]} / {outputs_inputs[1][i]}, dB")
    measured = _db(fit.test.H[:, o, i])
    axes.set_ylim(np.nanmin(measured) - 10, np.nanmax(measured) + 10)
    axes.legend(loc="best")
    return True


def worst(fit: FrfFit) -> tuple[int, int]:
    """Response and force of the function whose median error is the largest after the revision."""
    off = np.abs(fit.off_db(fit.revised))
    size = np.array([[_median(off[:, o, i]) for i in range(off.shape[2])] for o in range(off.shape[1])])
    return np.unravel_index(int(size.argmax()), size.shape)


def _median(values: np.ndarray) -> float:
    return float(np.nanmedian(values)) if np.isfinite(values).any() else -1.0


def _db(H: np.ndarray) -> np.ndarray:
    with np.errstate(divide="ignore"):
        return 20 * np.log10(np.abs(H))


PLOT = Plot("frf-overlay", 200, "The function met worst", draw, (Result,))
