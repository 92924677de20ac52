"""Measured modes that are none of the model's by their shape, and yet may be its own, as members that scatter mix them.

An error E of K, in coordinates of the modes of the model, has elements sqrt(2) tau sqrt(lambda_n lambda_p) g, g ~ N(0, 1), see
`configurations/shared.py`, and puts E_np / (lambda_n - lambda_p) of mode p into mode n, no more than all of it. In a mode that
swings where no sensor is, a few per cent of one that the sensors do see are all that they read.
"""

import numpy as np

from mouse_cli.diagnosis.gates import GATE
from mouse_cli.diagnosis.likelihoods.modal.repeated import SENSORS
from mouse_cli.diagnosis.search.fit import Fit
from mouse_cli.updating.chi_square import upper_tail

_SCATTER = 0.02  # tau: of members of one kind, by their dimensions and moduli
_NEAR = 3 * _SCATTER  # of ln f, between a measured mode and one of the model that it may be


def mixed(one: Fit, which: tuple[int, ...]) -> dict[int, np.ndarray]:
    """Those modes of the test, of `which` by their places, and the modes of the model, from 0, that such a one may be."""
    test, at = one.data.test, one.point
    detuning = np.abs(np.log(np.sqrt(np.maximum(at.eigenvalues, 1e-300)) / (2 * np.pi))[:, None] - np.log(test.frequency_hz))
    found = {}
    for j in which:
        near = np.flatnonzero(detuning[:, j] < _NEAR) if np.isfinite(test.shapes[:, j]).sum() >= SENSORS else np.zeros(0, int)
        if own := [n for n in near.tolist() if _may_be(one, j, n)]:
            found[j] = np.array(own)
    return found


def _may_be(one: Fit, j: int, n: int) -> bool:
    """Whether the shape of measured mode j is that of mode n of the model, with what scatter puts into it."""
    data, at = one.data, one.point
    lam = np.maximum(at.eigenvalues, 0.0)
    size = np.sqrt(2 * lam[n] * lam) * _SCATTER
    sd = np.zeros((data.m, len(lam)))
    sd[j] = np.divide(size, np.maximum(np.abs(lam[n] - lam), size), out=np.zeros(len(lam)), where=size > 0)
    sd[j, n] = 0.0
    modes = at.modes.copy()
    modes[j] = n
    rows = (data.modes == j) & (np.arange(len(data.modes)) >= data.has_frequency.sum())
    left = data.residual_beside(at.eigenvalues, at.seen, modes, sd)[rows]
    return upper_tail(float(left @ left), max(len(left) - 1, 1)) > GATE
