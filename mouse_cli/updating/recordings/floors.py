"""Noise of channels by the floor of their spectra."""

import numpy as np

LINES = 32  # spectral lines averaged for the noise floor
_LOWEST = 1.41  # white noise over the lowest tenth of means of so many


def floor(samples: np.ndarray) -> np.ndarray:
    """Noise of channels (t, s): the floor of their spectra, where the structure is quiet."""
    return lowest(levels(samples, np.hanning(len(samples) + 2)[1:-1, None]))


def lowest(levels: np.ndarray) -> np.ndarray:
    """sd (s,) by the lowest tenth of levels (g, s), times what it falls short of the level of white noise on average."""
    return np.sqrt(np.quantile(levels, 0.1, axis=0) * _LOWEST)


def levels(samples: np.ndarray, window: np.ndarray) -> np.ndarray:
    """Variance (g, s) that white noise of the level of each LINES neighbouring lines of channels (t, s) would have, by a window
    (t, s), or (t, 1) for all.
    """
    power = np.abs(np.fft.rfft((samples - samples.mean(axis=0)) * window, axis=0)) ** 2 / (window**2).sum(axis=0)
    power = power[1:] if len(power) > 1 else power
    lines = min(LINES, len(power))  # a few samples have fewer
    groups = len(power) // lines
    return power[: groups * lines].reshape(groups, lines, power.shape[1]).mean(axis=1)
