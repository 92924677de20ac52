"""Frequency response functions of periodic excitation: means over periods, and noise from their differences."""

from collections.abc import Sequence

import numpy as np

_EXCITED = 30.0  # the power of a line above its noise from which on it counts as excited
_FLOOR = 1e-10  # of the largest power


def periodic(experiments: Sequence[tuple[np.ndarray, np.ndarray]], period: int) -> tuple[np.ndarray, np.ndarray, int]:
    """H (f, o, i) and its variance at lines 1 to period // 2, NaN at those without excitation, and how many periods there were.

    experiments: x (t, i), y (t, o) of each, at least as many as forces. H = Y X^-1 of mean spectra (Pintelon & Schoukens, System
    Identification, 2nd ed. 2012, ch. 2, for one force); to first order dH = (dY - H dX) X^-1, whose variance is taken from
    r = y_p - H x_p over the P periods p: E|dH_oi|^2 = sum_e s2_oe / P |[X^-1]_ei|^2. NaN for a single period.
    """
    spectra = [[_spectra(samples, period) for samples in each] for each in experiments]
    X = np.stack([x.mean(axis=0) for x, _ in spectra], axis=-1)  # (f, i, e)
    Y = np.stack([y.mean(axis=0) for _, y in spectra], axis=-1)
    excited = _excited(X, [x for x, _ in spectra])
    inverse = np.full(X.shape[:1] + X.shape[:0:-1], np.nan, complex)
    inverse[excited] = np.linalg.pinv(X[excited])
    H = Y @ inverse
    variance = np.zeros(H.shape)
    for e, (x, y) in enumerate(spectra):
        P = len(x)
        residual = y - np.einsum("foi,pfi->pfo", H, x)
        spread = np.var(residual, axis=0, ddof=1) if P > 1 else np.full(residual.shape[1:], np.nan)
        variance += spread[:, :, None] / P * np.abs(inverse[:, e, None, :]) ** 2
    return H, variance, min(len(x) for x, _ in spectra)


def _spectra(samples: np.ndarray, period: int) -> np.ndarray:
    """Spectra (p, f, c) of the whole periods of samples (t, c), lines above 0 Hz."""
    from scipy.fft import rfft

    whole = len(samples) // period
    return rfft(samples[: whole * period].reshape(whole, period, -1), axis=1)[:, 1:]


def _excited(X: np.ndarray, inputs: list[np.ndarray]) -> np.ndarray:
    """Lines (f,) at which every force is well above its noise and above rounding in some experiment, and all are independent."""
    power = np.abs(X) ** 2
    noise = np.stack(
        [np.var(x, axis=0, ddof=1) / len(x) if len(x) > 1 else np.zeros(x.shape[1:]) for x in inputs], axis=-1
    )
    above = ((power > _EXCITED * noise) & (power > _FLOOR * power.max(axis=0))).any(axis=2).all(axis=1)
    above[above] = np.linalg.matrix_rank(X[above]) == X.shape[1]
    return above
