"""Signs of nonlinearity in recordings: coherence, lines that the excitation leaves out, and what changes with the level."""

from dataclasses import dataclass

import numpy as np

QUIET = 1e-3  # of the largest amplitude of the force: a line that is not excited
_COHERENT = 0.95


@dataclass(frozen=True)
class Distortion:
    """Of a periodic record whose force has odd lines only: rms of the response at lines that were excited, at even lines, and
    at odd lines that were not (nan without any); noise: between its periods, nan where there is one.
    """

    excited: float
    even: float
    odd: float
    noise: float


def incoherent(force: np.ndarray, response: np.ndarray, dt: float) -> float:
    """Share of the excited band in which the coherence of one force (t,) and one response (t,) is below 0.95."""
    from scipy.signal import coherence, welch

    length = min(len(force), max(256, 2 ** int(np.log2(max(len(force) // 16, 1)))))
    _, gamma = coherence(force, response, 1 / dt, nperseg=length)
    _, power = welch(force, 1 / dt, nperseg=length)
    own = power > 1e-4 * power.max()
    own[0] = False
    return float(np.mean(gamma[own] < _COHERENT))


def period(force: np.ndarray, shortest: int = 64) -> int | None:
    """Samples after which the force (t,) comes back (or changes sign, half a period before); None where it does not."""
    t = len(force)
    x = force - force.mean()
    spectrum = np.abs(np.fft.rfft(x, 2 * t)) ** 2
    product = np.fft.irfft(spectrum)[: t // 2]
    left = np.cumsum(x[::-1] ** 2)[::-1]
    right = np.cumsum(x**2)[::-1]
    size = np.sqrt(left[: t // 2] * right[: t // 2])
    likeness = product / np.where(size > 0, size, 1.0)
    whole = np.flatnonzero(likeness[shortest:] > 1 - QUIET) + shortest
    return int(whole[0]) if len(whole) else None


def distortion(force: np.ndarray, response: np.ndarray, length: int) -> Distortion | None:
    """Levels by line over whole periods of `length` samples, the first left out where there are more; None for even excitation."""
    count = len(force) // length
    if not count:
        return None
    first = min(1, count - 1)
    cut = lambda x: np.fft.rfft(x[first * length : count * length].reshape(-1, length), axis=1) / length
    F, X = cut(force), cut(response)
    mean, amplitude = X.mean(axis=0), np.abs(F.mean(axis=0))
    excited = amplitude > QUIET * amplitude.max()
    lines = np.arange(len(amplitude))
    if not excited.any() or (excited & (lines % 2 == 0) & (lines > 0)).any():
        return None
    band = (lines >= lines[excited].min()) & (lines <= lines[excited].max()) & (lines > 0)
    rms = lambda own: float(np.sqrt(np.mean(np.abs(mean[own]) ** 2))) if own.any() else float("nan")
    noise = float(np.sqrt((np.abs(X - mean) ** 2)[:, band].mean() / (len(X) - 1))) if len(X) > 1 else float("nan")
    return Distortion(rms(excited), rms(band & (lines % 2 == 0)), rms(band & (lines % 2 == 1) & ~excited), noise)
