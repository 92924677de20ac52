"""Bounds of errors in parameter estimation (lecture 21), against answers of perturbed problems computed anew by numpy."""

import numpy as np
import pytest

from mouse_cli.estimators import estimator
from mouse_cli.estimators.conditioning import conditioning
from mouse_cli.estimators.linear import LinearProblem

KEYS = {"bayes": True, "weighted-least-squares": False, "least-squares": False}


def stacked(problem: LinearProblem, weighted: bool, with_prior: bool) -> tuple[np.ndarray, np.ndarray]:
    """A and b of min |A z - b|, written out."""
    A, b = problem.T * problem.L, problem.d
    if weighted:
        A, b = A / problem.noise[:, None], b / problem.noise
    if with_prior:
        A, b = np.vstack([A, np.eye(A.shape[1])]), np.concatenate([b, np.zeros(A.shape[1])])
    return A, b


@pytest.mark.parametrize("key", KEYS)
@pytest.mark.parametrize("seed", range(4))
def test_bounds_hold_and_are_met(key, seed):
    rng = np.random.default_rng(seed)
    q, k = 30, 4
    T = rng.standard_normal((q, k)) @ np.diag([1.0, 0.5, 0.1, 0.03]) @ np.linalg.qr(rng.standard_normal((k, k)))[0]
    problem = LinearProblem(
        T,
        T @ rng.standard_normal(k) + 0.01 * rng.standard_normal(q),
        rng.uniform(0.01, 0.03, q),
        rng.uniform(0.5, 2, k),
    )
    how = estimator(key)
    z = how.solve(problem).z
    found = conditioning(problem, z, how.weighted, how.uses_prior)
    A, b = stacked(problem, how.weighted, how.uses_prior)
    assert np.allclose(z, np.linalg.lstsq(A, b, rcond=None)[0], rtol=1e-6)
    assert np.isclose(found.condition, np.linalg.cond(A), rtol=1e-6)
    size, eps, worst = np.linalg.norm(z), 1e-6, np.zeros(2)
    U = np.linalg.svd(A, full_matrices=False)[0]
    for trial in range(400):
        dA, db = rng.standard_normal(A.shape), rng.standard_normal(len(b))
        if trial == 0:
            db = U[:, -1]  # the worst error of the data
        dA *= eps * np.linalg.norm(A, 2) / np.linalg.norm(dA, 2)
        db *= eps * np.linalg.norm(b) / np.linalg.norm(db)
        moved = [np.linalg.lstsq(A + dA, b, rcond=None)[0] - z, np.linalg.lstsq(A, b + db, rcond=None)[0] - z]
        worst = np.maximum(worst, np.linalg.norm(moved, axis=1) / (eps * size))
    assert worst[0] <= found.sensitivities * 1.001
    assert worst[1] <= found.data * 1.001
    direction = found.weakest / np.linalg.norm(found.weakest)
    assert abs(direction @ np.linalg.svd(A)[2][-1]) > 1 - 1e-6


def test_the_bound_of_data_is_met():
    """By an answer along the largest singular direction, and an error along the smallest."""
    A = np.random.default_rng(7).standard_normal((12, 3)) @ np.diag([1.0, 0.2, 0.01])
    U, _, Vt = np.linalg.svd(A, full_matrices=False)
    problem = LinearProblem(A, A @ Vt[0], np.ones(12), np.ones(3))
    found = conditioning(problem, Vt[0], False, False)
    error = 1e-6 * np.linalg.norm(problem.d) * U[:, -1]
    moved = np.linalg.lstsq(A, problem.d + error, rcond=None)[0] - Vt[0]
    assert np.isclose(np.linalg.norm(moved), 1e-6 * found.data, rtol=1e-6)
    assert np.isclose(found.data, np.linalg.cond(A), rtol=1e-6)


def test_undetermined():
    problem = LinearProblem(np.array([[1.0, 1.0]]), np.ones(1), np.ones(1), np.ones(2))
    found = conditioning(problem, np.array([0.5, 0.5]), True, False)
    assert np.isinf(found.condition)
    assert np.allclose(np.abs(found.weakest), np.sqrt(0.5))
    assert found.weakest[0] * found.weakest[1] < 0
