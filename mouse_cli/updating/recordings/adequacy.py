"""Whether what a fit leaves of the records may be noise, with parameters where their prior allows them."""

import numpy as np

from mouse_cli.model.record_diagnosis import Noise
from mouse_cli.model.result import REJECT
from mouse_cli.updating.chi_square import upper_tail
from mouse_cli.updating.recordings.fit import Fit

MATERIAL, INADEQUATE = 1.1, 1.5  # ratios to the variance expected


def unlikely(baseline: Fit) -> bool:
    """Whether what the model leaves of the data is neither chance nor a trifle."""
    return upper_tail(baseline.misfit, max(int(baseline.dof), 1)) < REJECT and baseline.misfit > MATERIAL * baseline.dof


def close(one: Fit) -> bool:
    """Whether what a fit leaves of the data may be noise."""
    return one.misfit <= INADEQUATE * one.dof or upper_tail(one.misfit, max(int(one.dof), 1)) >= REJECT


def missing(baseline: Fit) -> bool:
    """Whether data, or the prior of the parameters that they moved, speak against the model: the innovation's two parts."""
    return unlikely(baseline) or strained(baseline)


def adequate(one: Fit) -> bool:
    """The same, with parameters where their prior allows them."""
    return close(one) and not strained(one)


def strained(one: Fit, scale: float | None = None) -> bool:
    """Whether nuisances are further from their prior than chance allows; scale: by what the fit leaves, unless it is known."""
    return shift_p(one, max(1.0, one.misfit / one.dof) if scale is None else scale) < REJECT


def shift_p(one: Fit, scale: float = 1.0) -> float:
    """p-value of the prior part of the cost: of all nuisances together, or of the furthest of so many."""
    z2 = shifted(one, scale) ** 2
    if not len(z2):
        return 1.0
    return min(upper_tail(float(z2.sum()), len(z2)), len(z2) * upper_tail(float(z2.max()), 1), 1.0)


def shifted(one: Fit, scale: float = 1.0) -> np.ndarray:
    """Nuisances z (k,) in prior sd, the deck's own parameters first, where the variances of the data are `scale` times the stated.

    With H = H_d + P the curvature of the cost, of data and of prior, the optimum moves by -(H_d/s + P)^-1 (1 - 1/s) P z.
    """
    k, x = one.hypothesis.nuisances, one.x
    if scale <= 1.0 or not len(one.covariance):
        return x[:k]
    P = np.diag(1 / one.hypothesis.sd**2)
    H = np.linalg.inv(one.covariance)
    step = np.linalg.solve((H - P) / scale + P, (1 - 1 / scale) * P @ (x - one.hypothesis.mean))
    return (x - step)[:k]


def innovation(one: Fit) -> float:
    """Misfit and prior part of the cost together."""
    return one.misfit + float((shifted(one) ** 2).sum())


def with_noise(one: Fit, quiet: Noise | None) -> float:
    """Times the stated variance that data are worth beside a fit: what it leaves, by the share of independent samples."""
    return max(1.0, one.misfit / one.dof) / (1.0 if quiet is None else quiet.effective)
