"""One frequency response function: measured, and what models make of it, with their bands and the coherence."""

import re
from typing import Any

import numpy as np

from mouse_cli.model.frf_fit import FrfFit
from mouse_cli.model.frf_test import KINDS
from mouse_cli.model.units import Units
from mouse_cli.observables.frf import names
from mouse_cli.plots import AFTER, BEFORE

_Z = 1.96  # half width of a band in standard deviations: 95 per cent
_WIDEST = 3.0  # of ln|H| beyond which a band is cut off
_DB = 20 / np.log(10)
_MARGIN = 6.0  # dB above and below what was measured
_GAP = 4.0  # times the distances beside it
_LOW = 4.0  # times the height of the coherence is that of the figure
_RATES = ("m/N", "m/(s N)", "m/(s2 N)")  # unit of receptance, mobility, accelerance
_TURNS = re.compile(r"R[XYZ]$")


def colours(fit: FrfFit) -> list[str]:
    """One for each model: the last of several is the one that was sought."""
    return [BEFORE] if len(fit.models) == 1 else [BEFORE, AFTER]


def unbroken(hz: np.ndarray) -> np.ndarray:
    """Frequencies (f,) with NaN for the first line behind a gap, so that no curve is drawn across it."""
    apart = np.diff(hz)
    spacing = np.maximum(np.append(apart[1:], 0.0), np.append(0.0, apart[:-1]))
    return np.where(np.append(False, apart > _GAP * spacing) if len(apart) > 1 else False, np.nan, hz)


def overlay(fit: FrfFit, o: int, i: int, units: Units, axes: Any) -> None:
    """Magnitudes in dB over frequency; bands of 95 % of the models, and of what was measured."""
    hz = unbroken(fit.test.frequency_hz)
    measured = decibels(fit.test.H[:, o, i])
    with np.errstate(divide="ignore", invalid="ignore"):
        ribbon(axes, hz, measured, fit.sd[:, o, i] / np.abs(fit.test.H[:, o, i]), "black", 0.15)
    axes.plot(hz, measured, color="black", lw=1.6, alpha=0.55, label="measured")
    for model, colour, style in zip(fit.models, colours(fit), ("--", "-"), strict=False):
        level = decibels(model.H[:, o, i])
        ribbon(axes, hz, level, model.sd[:, o, i], colour, 0.25)
        axes.plot(hz, level, style if len(fit.models) > 1 else "-", color=colour, lw=1.0, label=model.name)
    _labelled(fit, o, i, units, axes)
    _coherence(fit, o, axes)
    axes.set_xlim(fit.test.frequency_hz[0], fit.test.frequency_hz[-1])
    fitted_height(fit, o, i, np.ones(len(hz), bool), axes)
    axes.legend(loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=3, borderaxespad=0.1)


def fitted_height(fit: FrfFit, o: int, i: int, shown: np.ndarray, axes: Any) -> None:
    """Limits that hold what was measured at the lines `shown` (f,), with room below for the coherence."""
    known = decibels(fit.test.H[shown, o, i])
    known = known[np.isfinite(known)]
    if len(known):
        low, high = known.min() - _MARGIN, known.max() + _MARGIN
        axes.set_ylim(low - (high - low) / (_LOW - 1) if fit.test.coherence is not None else low, high)


def _labelled(fit: FrfFit, o: int, i: int, units: Units, axes: Any) -> None:
    (response, force), kind = (each[k] for each, k in zip(names(fit.test), (o, i), strict=True)), fit.test.kind
    turns = _TURNS.search(response) or _TURNS.search(force)
    unit = "" if turns or not units.declared else f" re 1 {units.of(_RATES[KINDS[kind]])}"
    axes.set_xlabel("frequency, Hz")
    axes.set_ylabel(f"{kind} {response} / {force},\ndB{unit}")


def _coherence(fit: FrfFit, o: int, axes: Any) -> None:
    """On an axis of its own at the foot of the figure, from 0 to 1."""
    if fit.test.coherence is None:
        return
    right = axes.twinx()
    right.plot(unbroken(fit.test.frequency_hz), fit.test.coherence[:, o], color="C2", lw=0.8)
    right.set_ylim(0, _LOW)
    right.set_yticks([0, 1])
    right.set_ylabel("coherence", loc="bottom", color="C2")
    right.spines["right"].set_visible(True)
    right.grid(visible=False)


def worst(fits: tuple[FrfFit, ...], which: int) -> tuple[FrfFit, int, int]:
    """Measurement, response and force of the function that model number `which` meets worst, over its noise."""
    found = []
    for fit in fits:
        size = np.nansum(fit.off_sd(fit.models[which].H) ** 2, axis=0)
        o, i = np.unravel_index(int(size.argmax()), size.shape)
        found.append((float(size[o, i]), fit, int(o), int(i)))
    return max(found, key=lambda each: each[0])[1:]


def ribbon(axes: Any, hz: np.ndarray, level: np.ndarray, sd: np.ndarray, colour: str, alpha: float) -> None:
    """95 per cent about a level in dB, for sd of ln|H|; nothing where they are not known."""
    half = _Z * _DB * np.minimum(sd, _WIDEST)
    if np.isfinite(half).any():
        axes.fill_between(hz, level - half, level + half, color=colour, alpha=alpha, lw=0)


def decibels(H: np.ndarray) -> np.ndarray:
    """20 log10 |H|."""
    with np.errstate(divide="ignore"):
        return 20 * np.log10(np.abs(H))
