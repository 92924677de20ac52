"""The evidence of own states that go on from stretch to stretch, against the marginal likelihood of all of them at once."""

import numpy as np
from scipy.stats import multivariate_normal

from mouse_cli.updating.recordings.continuity import Stretch, _filtered

_COUNT, _STATES, _SEEN, _SHARE = 4, 6, 9, 0.3
_OWN = np.array([2, 5])  # of displacements and velocities of three motions


def test_the_gain_is_the_ratio_of_marginal_likelihoods():
    rng = np.random.default_rng(5)
    spread = rng.uniform(0.5, 2.0, _STATES)
    X = rng.normal(size=(_COUNT, _SEEN, _STATES))
    carried = 0.4 * rng.normal(size=(_COUNT, len(_OWN), _STATES))
    offset = rng.normal(size=(_COUNT, len(_OWN)))
    apart = _joint(spread, np.zeros_like(carried), np.zeros_like(offset), spread[_OWN])
    linked = _joint(spread, carried, offset, _SHARE * spread[_OWN])
    data = multivariate_normal(*_seen(X, *linked)).rvs(random_state=rng)
    stretches = []
    for j, seen in enumerate(data.reshape(_COUNT, _SEEN)):
        precision = X[j].T @ X[j] + np.diag(spread**-2.0)
        begun = np.linalg.solve(precision, X[j].T @ seen)
        stretches.append(Stretch(begun, precision, offset[j] + carried[j] @ begun, carried[j]))
    exact = multivariate_normal(*_seen(X, *linked)).logpdf(data) - multivariate_normal(*_seen(X, *apart)).logpdf(data)
    assert np.isclose(_filtered(stretches, _OWN, spread[_OWN], _SHARE), exact, rtol=1e-9)


def _joint(spread, carried, offset, jump):
    """Mean and covariance of the states of all stretches: own ones that follow the stretch before, and independent others."""
    size = _COUNT * _STATES
    onward, mean, own = np.eye(size), np.zeros(size), np.tile(spread, _COUNT)
    for j in range(1, _COUNT):
        rows, before = j * _STATES + _OWN, slice((j - 1) * _STATES, j * _STATES)
        onward[rows, before] = -carried[j - 1]
        mean[rows], own[rows] = offset[j - 1], jump
    back = np.linalg.inv(onward)
    return back @ mean, back @ np.diag(own**2) @ back.T


def _seen(X, mean, covariance):
    """The same of what is measured, with noise of 1."""
    reads = np.zeros((_COUNT * _SEEN, _COUNT * _STATES))
    for j, one in enumerate(X):
        reads[j * _SEEN : (j + 1) * _SEEN, j * _STATES : (j + 1) * _STATES] = one
    return reads @ mean, reads @ covariance @ reads.T + np.eye(len(reads))
