"""A steady tone that no measured force has: a motor, a fan, hum of the mains at another frequency than the grid's.

A mode of its own that hardly loses energy follows it within a stretch, in which its state is free. What it is shows over the whole
record: one amplitude and one phase, whatever the measured force does.
"""

from dataclasses import dataclass, replace

import numpy as np

from mouse_cli.updating.recordings.acting import Place
from mouse_cli.updating.recordings.disturbance import Disturbance
from mouse_cli.updating.recordings.free_force import Spectrum
from mouse_cli.updating.recordings.hypothesis import Hypothesis
from mouse_cli.updating.recordings.noise import predicted
from mouse_cli.updating.recordings.regression import Regression

_LEAST, _STEADY = 0.1, 0.15  # share of what is left that it has; of what is left about its line, that remains without it
_ABOUT = 12  # lines on either side of it
_ROUNDS = 4  # of a tone and the parameters that follow it
_CYCLES = 20  # that a record has of it, at least
_LINE = 5.0  # times the median of the lines about it, from which on a force has a line there itself
_PARTS, _PERSISTENT = 8, 0.2  # of a record, and of the rms of its force that each has, so that nothing rings down freely


@dataclass(frozen=True)
class Tone:
    """hz; share: of what the model leaves."""

    hz: float
    share: float

    def said(self) -> str:
        """What to do, in a sentence."""
        return (
            f"The records hold a steady tone at {self.hz:.5g} Hz, {100 * self.share:.2g} % of what the model leaves: of one "
            "amplitude and one phase throughout, which no measured force makes. Something that runs by itself drives the structure "
            "or its sensors (a motor, a fan, hum), and a hidden oscillator would look the same in a short stretch. Stop it, or "
            f"write mains: {self.hz:.5g} for the recordings, and diagnose again."
        )


def tone(spectrum: Spectrum, base: Hypothesis, places: list[Place]) -> Tone | None:
    """The loudest steady tone of what the model leaves; None where there is none, or it is left out of fits already."""
    series = spectrum.series
    look = lambda series: Regression(replace(spectrum, series=series), base.placed(places[0]))
    at = look(series)
    force, left = series.force[at.kept], at.left[at.kept]
    if series.slow or not (series.free or _persistent(force)):
        return None
    power, hz = _spectrum(left).sum(axis=1), np.fft.rfftfreq(len(left), series.dt)
    power[hz < _CYCLES * hz[1]] = 0.0
    f, rest, steady = float(hz[int(power.argmax())]), left, np.zeros_like(series.measured)
    for _ in range(_ROUNDS):
        f, steady = _fitted(rest + steady[at.kept], series.dt, f, hz[1], at.kept.start, len(steady))
        if series.free:  # the state in which it begins follows what is taken off
            rest = left - steady[at.kept]
            break
        rest = look(replace(series, measured=series.measured - steady * series.sd)).left[at.kept]
    near = np.abs(hz - f) <= _ABOUT * hz[1]
    share = 1 - float((rest**2).sum() / (left**2).sum())
    if share < _LEAST or _spectrum(rest).sum(axis=1)[near].sum() > _STEADY * power[near].sum():
        return None
    if _left_out(series.disturbance, f, hz[1]) or _driven(force, hz, f) or (series.free and not _dies_away(predicted(at))):
        return None
    return Tone(f, share)


def _spectrum(x: np.ndarray) -> np.ndarray:
    """Power (l, s) of every line of x (t, s)."""
    return np.abs(np.fft.rfft(x * np.hanning(len(x))[:, None], axis=0)) ** 2


def _fitted(x: np.ndarray, dt: float, begin: float, line: float, first: int, count: int) -> tuple[float, np.ndarray]:
    """Frequency, Hz, of the sinusoid of one amplitude and phase in each channel that takes most of x (t, s), and it (count, s), of
    which x begins at sample `first`. It is within a `line` of where it is sought.
    """
    from scipy.optimize import minimize_scalar

    t = dt * (np.arange(count) - first)
    columns = lambda f: np.column_stack([np.cos(2 * np.pi * f * t), np.sin(2 * np.pi * f * t)])
    own = slice(first, first + len(x))

    def left(f: float) -> float:
        A = columns(f)[own]
        return -float(((A @ np.linalg.lstsq(A, x, rcond=None)[0]) ** 2).sum())

    f = float(minimize_scalar(left, bounds=(begin - line, begin + line), method="bounded", options={"xatol": 1e-4 * line}).x)
    return f, columns(f) @ np.linalg.lstsq(columns(f)[own], x, rcond=None)[0]


def _dies_away(x: np.ndarray) -> bool:
    """Whether the motion (t, s) of a free decay is over before its record is."""
    first, *_, last = (float(np.sqrt((part**2).mean())) for part in np.array_split(x, _PARTS))
    return last < _PERSISTENT * first


def _persistent(force: np.ndarray) -> bool:
    """Whether a measured force acts throughout the record."""
    rms = lambda x: float(np.sqrt((x**2).mean())) if x.size else 0.0
    return rms(force) > 0 and all(rms(part) > _PERSISTENT * rms(force) for part in np.array_split(force, _PARTS))


def _driven(force: np.ndarray, hz: np.ndarray, f: float) -> bool:
    """Whether a force has a line there itself, or all of its lines elsewhere: of a sweep or a period the answer is steady too."""
    power, distance = _spectrum(force), np.abs(hz - f)
    near, line = (distance <= 3 * _ABOUT * hz[1]) & (distance > 3 * hz[1]), distance <= 1.5 * hz[1]
    return bool((power[line].max(axis=0) > _LINE**2 * np.median(power[near], axis=0)).any())


def _left_out(stated: Disturbance, f: float, line: float) -> bool:
    """Whether the recordings state it."""
    return bool(stated.lost(np.array([0.0, line, f]))[2])
