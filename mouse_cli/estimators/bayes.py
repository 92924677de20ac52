"""Bayes: what was believed before the test and what the test says, each weighed by its covariance. Eqs. (3-50) to (3-60)."""

import numpy as np

from mouse_cli.estimators._linear import Estimator, LinearEstimate, LinearProblem, conditioned, limited

_LARGE = 1e7  # norm of B above which I + B'B would lose the prior to rounding: then QR of [B; I]


def solve(problem: LinearProblem) -> LinearEstimate:
    """x* = x_p + S T'(R + T S T')^-1 (y - T x_p), S* = S - S T'(R + T S T')^-1 T S, by square roots.

    With B = R^-1/2 T L: z = (I + B'B)^-1 B'r, on whichever side is smaller. Never fails for want of data: where they say
    nothing, the prior stays.
    """
    B, r = problem.whiten(problem.in_prior_units()), problem.whiten(problem.d)
    q, k = B.shape
    if problem.lower is not None or k <= q or np.abs(B).max(initial=0.0) > _LARGE:
        return _by_properties(problem, B, r)
    return _by_data(problem, B, r)


def _by_properties(problem: LinearProblem, B: np.ndarray, r: np.ndarray) -> LinearEstimate:
    """C'C = I + B'B (k, k): C by Cholesky, or by QR of [B; I] where B is large."""
    q, k = B.shape
    if np.abs(B).max(initial=0.0) > _LARGE:
        Q, C = np.linalg.qr(np.vstack([B, np.eye(k)]))
        z = np.linalg.solve(C, Q[:q].T @ r)
    else:
        C = np.linalg.cholesky(np.eye(k) + B.T @ B).T
        z = np.linalg.solve(C, np.linalg.solve(C.T, B.T @ r))
    root_z, at_limit = np.linalg.inv(C), np.zeros(problem.T.shape[1], bool)
    if problem.lower is not None:
        z, active = limited(problem, z, C)
        root_z, at_limit = conditioned(problem, root_z, active)
    U = problem.expand(root_z)
    return LinearEstimate(problem.expand(z), z, np.einsum("ij,ij->i", U, U), lambda: U, at_limit)


def _by_data(problem: LinearProblem, B: np.ndarray, r: np.ndarray) -> LinearEstimate:
    """C C' = I + B B' (q, q); only variances are formed unless the covariance is asked for."""
    q, k = B.shape
    C = np.linalg.cholesky(np.eye(q) + B @ B.T)
    Y = np.linalg.solve(C, B)
    z = Y.T @ np.linalg.solve(C, r)
    prior = (
        problem.expand(np.ones(k)) ** 2
        if problem.L.ndim == 1
        else np.einsum("ij,ij->i", problem.L, problem.L)
    )
    explained = problem.expand(Y.T)

    def root() -> np.ndarray:
        """L (I - Y'Y)^1/2, symmetric square root by the singular values of Y."""
        _, s, Vt = np.linalg.svd(Y, full_matrices=False)
        shrink = 1.0 - np.sqrt(np.maximum(1.0 - s**2, 0.0))
        return problem.expand(np.eye(k) - (Vt.T * shrink) @ Vt)

    variance = np.maximum(prior - np.einsum("ij,ij->i", explained, explained), 0.0)
    return LinearEstimate(problem.expand(z), z, variance, root, np.zeros(problem.T.shape[1], bool))


ESTIMATOR = Estimator(
    "bayes",
    "Bayes",
    "x* = x_p + S T'(R + T S T')^-1 (y - T x_p); S* = S - S T'(R + T S T')^-1 T S",
    True,
    True,
    solve,
)
