"""A point mass on an arm has inertia about two axes: along the third the mass matrix is singular, wherever the arm points."""

import numpy as np
import pytest
from scipy.linalg import null_space

from mouse_cli.dynamics.eigen import dense_solution

RATES = np.diag([4e5, 7e5, 3e5])  # N m/rad
ARMS = [(0.03, 0.02, -0.05), (0.1, 0.2, 0.15), (1.0, 0.3, -0.7), (1e-3, 2e-2, 0.4), (0.3, -6.5e-3, -2.8e-3), (0.023, -3.5, -3e-4)]


@pytest.mark.parametrize("arm", ARMS)
def test_a_motion_along_the_arm_follows_the_others_statically(arm):
    r, mass = np.array(arm), 2.5
    M = mass * (r @ r * np.eye(3) - np.outer(r, r))
    across = null_space(r[None])  # (3, 2)
    K = RATES - np.outer(RATES @ r, RATES @ r) / (r @ RATES @ r)
    expected = np.linalg.eigvalsh(across.T @ K @ across) / (mass * (r @ r))
    found = dense_solution(RATES, M)
    assert found.eigenvalues == pytest.approx(expected, rel=1e-9)
    assert found.shapes.T @ M @ found.shapes == pytest.approx(np.eye(2), abs=1e-9)
