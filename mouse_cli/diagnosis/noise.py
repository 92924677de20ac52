"""Noise that is larger than stated, integrated out: variances times s^2, with ln s >= 0 exponential of rate 6.

A misfit m on d degrees of freedom then has the density

    integral over s >= 1 of 6 s^-6 s^-d exp(-m / 2 s^2) ds/s = 3 gamma(a, m/2) (m/2)^-a,     a = (d + 6) / 2

so that an explanation which leaves too much pays for the noise that it needs, and one without degrees of freedom needs none.
"""

import numpy as np

LOUD = 4.0  # scale of variances beyond which no error of the test is all, and as much is sought as beside a test that is trusted
RATE = 6.0  # of the prior of ln s: standard deviations are twice what was stated, or more, in 1 test of 64


def log_density(misfit: np.ndarray, dof: float) -> np.ndarray:
    """ln of it, for misfits (...,) that all have `dof` degrees of freedom.

    >>> np.exp(log_density(np.array([0.0]), 0)).round(6).tolist()
    [1.0]
    """
    from scipy.special import gammainc, gammaln, hyp1f1

    x, a = np.asarray(misfit, float) / 2, (max(dof, 0) + RATE) / 2
    share = gammainc(a, x)
    small = share < 1e-200
    with np.errstate(divide="ignore", over="ignore", invalid="ignore"):
        large = gammaln(a) + np.log(share) - a * np.log(x)
        series = np.log(hyp1f1(1.0, a + 1, np.where(small, x, 0.0))) - x - np.log(a)
    return np.log(RATE / 2) + np.where(small, series, large)


def scale(misfit: float, dof: float) -> float:
    """The most probable s^2, 1 at least."""
    return max(1.0, misfit / (max(dof, 0) + RATE))
