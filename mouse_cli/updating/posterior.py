"""The posterior density as it is: the prior and the likelihood of a run at any place, and the normal density that a run puts there.

In z, where the prior is the unit sphere: -log p = J/2, J = |R^-1/2 (y - h(u_p + L z))|^2 + |z|^2, which the anchored recursion
minimises; beyond limits, and where the model is not physical, p = 0.
"""

from dataclasses import dataclass

import numpy as np

from mouse_cli.estimators.linear import expand, in_prior_units
from mouse_cli.updating.state import Setting, State, attempt

_ROUNDING = 1e-6  # share by which equal sizes may differ


def place(setting: Setting, z: np.ndarray) -> np.ndarray:
    """Coordinates u (p,) at z (k,)."""
    return setting.coordinates.mean + expand(setting.coordinates.L, z)


def cost(setting: Setting, z: np.ndarray) -> tuple[float, State | None]:
    """J at z (k,) and the state there; infinite and None where the posterior density is zero."""
    u = place(setting, z)
    if not setting.coordinates.within(u):
        return np.inf, None
    state = attempt(setting, u)
    if state is None or not np.isfinite(state.chi2):
        return np.inf, None
    return state.chi2 + float(z @ z), state


@dataclass(frozen=True)
class Laplace:
    """The normal density at a mode of the posterior: mean z (k,), covariance root root' with root (k, k), J at the mode.

    root: principal axes as columns, each one standard deviation long, the longest first.
    """

    setting: Setting
    state: State
    z: np.ndarray
    root: np.ndarray
    cost: float

    @property
    def covariance(self) -> np.ndarray:
        """Covariance (p, p) of the values of the parameters, to first order."""
        root = expand(self.setting.coordinates.L, self.root)
        root = root * self.setting.coordinates.slope(self.state.u)[:, None]
        return root @ root.T

    @property
    def log_evidence(self) -> float:
        """log of its share of the evidence, up to what all modes have in common: -J/2 + log det root."""
        return -0.5 * self.cost + float(np.linalg.slogdet(self.root)[1])

    def length(self, z: np.ndarray) -> float:
        """Distance of z (k,) from the mode in standard deviations."""
        return float(np.linalg.norm(np.linalg.solve(self.root, z - self.z)))


def leading(size: np.ndarray) -> np.ndarray:
    """Row of the largest value of each column; the first of those that differ by rounding alone. None of no columns."""
    if not size.size:
        return np.zeros(0, int)
    return (size >= (1 - _ROUNDING) * size.max(axis=0)).argmax(axis=0)


def laplace(setting: Setting, state: State) -> Laplace:
    """The normal density at `state`, with the covariance (I + B'B)^-1 in z, B = R^-1/2 T L."""
    coordinates = setting.coordinates
    z = coordinates.in_prior_units(state.u - coordinates.mean)
    B = in_prior_units(state.T, coordinates.L) / setting.sd[:, None]
    precision, axes = np.linalg.eigh(np.eye(len(z)) + B.T @ B)
    precision = np.maximum(precision, 1.0)  # the prior's, below which rounding alone brings it
    axes = axes * np.sign(axes[leading(np.abs(axes)), np.arange(len(z))])
    return Laplace(setting, state, z, axes / np.sqrt(precision), state.chi2 + float(z @ z))
