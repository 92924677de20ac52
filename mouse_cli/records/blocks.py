"""Recordings cut into windowed blocks, and the mean products of their spectra."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from mouse_cli.model.spectra import SpectraOptions

_BATCH = 64  # blocks transformed at once: bounds the memory of long recordings


@dataclass(frozen=True)
class Products:
    """Means over blocks of products of spectra, up to one real factor.

    Gxx (f, i, i): E[x x^H]; Gyx (f, o, i): E[y x^H]; Gyy (f, o): E|y|^2. averages: effective number of independent blocks.
    """

    Gxx: np.ndarray
    Gyx: np.ndarray
    Gyy: np.ndarray
    averages: float
    blocks: int


def window(name: str, n: int, final: float) -> np.ndarray:
    """The window (n,); exponential: exp(-k ln(1/final) / n), which is `final` after the last sample."""
    from scipy.signal import get_window

    if name == "exponential":
        return np.exp(np.log(final) / n * np.arange(n))
    return get_window("boxcar" if name == "uniform" else name, n)


def decay_rate(final: float, seconds: float) -> float:
    """What an exponential window of so many seconds adds to the decay rate of every mode, 1/s.

    Force and response times e^(-a t) have Fourier transforms that are their Laplace transforms at s = i omega + a. Their quotient
    is H(s) there: as a function of omega its poles lie farther left by a, so zeta omega_n = a' - a of the a' that is identified.
    """
    return -float(np.log(final)) / seconds


def starts(n: int, block: int, overlap: float) -> np.ndarray:
    """First samples of the blocks of a recording of n samples."""
    step = max(1, block - round(overlap * block))
    return np.arange(0, n - block + 1, step)


def effective_averages(w: np.ndarray, blocks: int, overlap: float) -> float:
    """n_e = K / (1 + 2 sum_j (1 - j/K) rho_j), rho_j = (sum_k w_k w_{k + jD})^2 / (sum w^2)^2 (Welch, IEEE AU-15, 1967).

    K blocks that begin D samples apart and overlap hold less than K independent ones.
    """
    n, K = len(w), blocks
    step = max(1, n - round(overlap * n))
    lags = np.arange(1, min(K - 1, (n - 1) // step) + 1)
    rho = np.array([np.dot(w[: n - j * step], w[j * step :]) for j in lags]) ** 2 / np.dot(w, w) ** 2
    return K / (1 + 2 * float(np.sum((1 - lags / K) * rho))) if K else 0.0


def products(
    pieces: Sequence[tuple[np.ndarray, np.ndarray, np.ndarray]], block: int, options: SpectraOptions
) -> Products:
    """Mean products over the blocks of all pieces (x (t, i), y (t, o), first samples of its blocks), lines 1 to block // 2.

    The mean of each block is taken out first, but for strokes of a hammer, which are not around a mean.
    """
    from scipy.fft import rfft

    w = window(options.taken, block, options.final)
    sums: list[np.ndarray | float] = [0.0, 0.0, 0.0]
    count, effective = 0, 0.0
    for x, y, begin in pieces:
        for at in range(0, len(begin), _BATCH):
            index = begin[at : at + _BATCH, None] + np.arange(block)
            X, Y = (_lines(rfft, samples[index], w, options) for samples in (x, y))
            sums[0] += np.einsum("kfi,kfj->fij", X, X.conj(), optimize=True)
            sums[1] += np.matmul(Y.transpose(1, 2, 0), X.conj().transpose(1, 0, 2))
            sums[2] += np.sum(Y.real**2 + Y.imag**2, axis=0)
        count += len(begin)
        effective += len(begin) if options.impact else effective_averages(w, len(begin), options.shared)
    return Products(*(each / max(count, 1) for each in sums), effective, count)


def _lines(rfft, blocks: np.ndarray, w: np.ndarray, options: SpectraOptions) -> np.ndarray:
    """Spectra (k, f, c) of blocks (k, t, c) at the lines above 0 Hz."""
    if not options.impact:
        blocks = blocks - blocks.mean(axis=1, keepdims=True)
    return rfft(blocks * w[:, None], axis=1)[:, 1:]
