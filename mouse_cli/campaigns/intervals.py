"""Intervals and standard deviations of replicates (Efron and Tibshirani, An Introduction to the Bootstrap, 1993)."""

import numpy as np

LEVEL = 0.95


def percentile(replicates: np.ndarray) -> np.ndarray:
    """Ends (2,) of the interval between quantiles of replicates (b,); section 13.3."""
    return np.quantile(replicates, [(1 - LEVEL) / 2, (1 + LEVEL) / 2])


def bca(replicates: np.ndarray, value: float, left_out: list[np.ndarray]) -> np.ndarray:
    """Ends (2,) of the bias-corrected, accelerated interval; section 14.3. left_out: for each sample, answers without one unit.

    z0 = Phi^-1(share of replicates below the value, ties by half); a = sum l^3 / n^3 / 6 (sum l^2 / n^2)^(3/2), where
    l = (n - 1)(mean - left out), summed over the n units of every sample. NaN where all replicates lie to one side.
    """
    from scipy.special import ndtr, ndtri

    below = (np.mean(replicates < value) + np.mean(replicates <= value)) / 2
    z0 = ndtri(below)
    parts = [((len(x) - 1) * (x.mean() - x), len(x)) for x in left_out]
    cubes = sum(float(np.sum(l**3)) / n**3 for l, n in parts)
    squares = sum(float(np.sum(l**2)) / n**2 for l, n in parts)
    a = cubes / (6 * squares**1.5) if squares > 0 else 0.0
    z = z0 + ndtri(np.array([(1 - LEVEL) / 2, (1 + LEVEL) / 2]))
    with np.errstate(invalid="ignore"):
        shares = ndtr(z0 + z / (1 - a * z))
    return np.quantile(replicates, shares) if np.isfinite(shares).all() else np.full(2, np.nan)


def jackknife_sd(left_out: list[np.ndarray]) -> float:
    """Root of sum (n - 1)/n sum (left out - mean)^2 over the samples; section 11.2."""
    return float(np.sqrt(sum((len(x) - 1) / len(x) * np.sum((x - x.mean()) ** 2) for x in left_out)))
