"""The second-order step: the curvature of the data along the first-order step, from one exact re-solution.

With the step v of the linearised problem, h'' = (2/h) ((h(u + h v) - h(u))/h - T v) and the correction is a = 1/2 of the
linear answer to the residual -h'' (geodesic acceleration; Transtrum and Sethna 2012).
"""

import numpy as np

from mouse_cli.estimators.linear import Estimator, LinearProblem
from mouse_cli.updating.state import Setting, State, attempt

_PROBE = 0.1  # share of the step at which the curvature is taken
_TRUST = 0.75  # a correction longer than this share of the step means that two orders are not enough


def acceleration(setting: Setting, state: State, step: np.ndarray, estimator: Estimator) -> np.ndarray:
    """Correction (p,) to the first-order `step` (p,); zero where the model cannot be probed or two orders do not suffice."""
    probe = attempt(setting, state.u + _PROBE * step)
    if probe is None:
        return np.zeros_like(step)
    curvature = 2 / _PROBE * ((probe.predicted - state.predicted) / _PROBE - state.T @ step)
    problem = LinearProblem(state.T, -curvature, setting.sd, setting.coordinates.L)
    correction = 0.5 * estimator.solve(problem).x
    first, second = (np.linalg.norm((state.T @ v) / setting.sd) for v in (step, correction))
    return correction if second <= _TRUST * first else np.zeros_like(step)
