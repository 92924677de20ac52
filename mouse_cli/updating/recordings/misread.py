"""A first look at errors of channels: the gain, or the delay, of each channel that leaves least beside all nuisances."""

from collections.abc import Iterator

import numpy as np

from mouse_cli.updating.recordings.acting import Place
from mouse_cli.updating.recordings.calibration import answer, as_read, only
from mouse_cli.updating.recordings.channels import GAINS, Misreading, earlier
from mouse_cli.updating.recordings.regression import Regression, Start

_ROUNDS = 4  # of Gauss and Newton from each delay that is tried
_PEAKS, _FINE = 4, 4  # delays at which record and model resemble each other most; steps of them in a sample
_SPAN = 64  # samples that they may be apart


def misread(at: Regression, channels: list[Place], laws: list[Misreading]) -> Iterator[Start]:
    """The best size of each error of each channel."""
    for place in channels:
        for law in laws:
            found = _gain(at, place) if law.key == "sensor-gain" else _delay(at, place, law)
            if found is not None:
                value, column = found
                yield _start(at, place, law, value, column)


def _start(at: Regression, place: Place, law: Misreading, value: float, column: np.ndarray) -> Start:
    """value: with its sign; column (t,): what it changes of the outputs as they should be read."""
    hypothesis = at.base.placed(place).at(law, int(value < 0))
    x, left = at.begin(column, np.log([abs(value)]))
    return Start(hypothesis, np.clip(x, *hypothesis.bounds), left)


def _gain(at: Regression, place: Place) -> tuple[float, np.ndarray] | None:
    """y/g = y - h y, h = 1 - 1/g; of a force f/g, which takes h of its answer off that of the model."""
    s, c = at.spectrum, place.channel
    own = only(as_read(s), c) if c < s.series.measured.shape[1] else -answer(s, c - s.series.measured.shape[1])
    column = at.stacked(own)
    free = at.projected(column)
    size = float(free @ free)
    h = float(free @ at.target) / size if size > 0 else 0.0
    if h == 1 or not GAINS[0] < abs(1 / (1 - h)) < GAINS[1]:
        return None
    return 1 / (1 - h), h * column


def _delay(at: Regression, place: Place, law: Misreading) -> tuple[float, np.ndarray] | None:
    """From the delays at which the channel resembles the model most, and from none, by Gauss and Newton."""
    y, dt, c = as_read(at.spectrum), at.spectrum.series.dt, place.channel
    s, low, high = y.shape[1], law.unknowns(place.scale)[0].lower, law.unknowns(place.scale)[0].upper
    own, turn = (only(y, c), 1.0) if c < s else (y, -1.0)
    if c >= s and at.spectrum.series.force.shape[1] > 1:
        return None  # of one of several forces: no delay of outputs is the same
    mean = own.mean(axis=0)
    late = lambda tau: earlier(own - mean, dt, np.full(s, turn * tau))
    model = y - at.spectrum.missing
    best: tuple[float, float, np.ndarray] | None = None
    for tau in (0.0, *_resembling(own, only(model, c) if c < s else model, turn * dt)):
        for _ in range(_ROUNDS):
            column = at.stacked(own - mean - late(tau))
            left = at.target - at.projected(column)
            if low < abs(tau) < high and (best is None or left @ left < best[0]):
                best = float(left @ left), tau, column
            step = 0.5 * dt
            slope = at.projected(at.stacked(late(tau + step) - late(tau - step)) / (2 * step))
            tau -= float(slope @ left) / max(float(slope @ slope), 1e-300)
            if not abs(tau) < high:
                break
    return None if best is None else best[1:]


def _resembling(own: np.ndarray, model: np.ndarray, dt: float) -> list[float]:
    """Delays (s) of channels (t, s) behind those of the model at the highest peaks of their correlation."""
    size = 2 * len(own)
    cross = (np.fft.rfft(own, size, axis=0) * np.fft.rfft(model, size, axis=0).conj()).sum(axis=1)
    found = np.fft.irfft(cross, _FINE * size)
    lags = np.arange(-_SPAN * _FINE, _SPAN * _FINE + 1)
    r = found[lags]
    peaks = np.flatnonzero((r[1:-1] > r[:-2]) & (r[1:-1] >= r[2:])) + 1
    return [float(lags[i]) * dt / _FINE for i in peaks[np.argsort(-r[peaks])][:_PEAKS]]
