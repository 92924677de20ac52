"""Bayes: what was believed before the test and what the test says, each weighed by its covariance. Eqs. (3-50) to (3-60)."""

from functools import cache

import numpy as np

from mouse_cli.estimators.linear import Estimator, LinearEstimate, LinearProblem, conditioned, limited

_LARGE = 1e3  # length of a column of B above which I + B'B would lose digits of the prior: then QR of [B; I]
_WORTH_LOADING = 500  # order of a triangular system from which on scipy is worth loading
_SEEN = 1e-4  # share of a variance that the data do not see, below which it is not formed as a difference


def solve(problem: LinearProblem) -> LinearEstimate:
    """x* = x_p + S T'(R + T S T')^-1 (y - T x_p), S* = S - S T'(R + T S T')^-1 T S, by square roots.

    With B = R^-1/2 T L: z = (I + B'B)^-1 B'r, within the row space of B where that is smaller. Never fails for want of
    data: where they say nothing, the prior stays.
    """
    B, r = problem.whitened()
    q, k = B.shape
    if q < k and problem.lower is None:
        return _within_row_space(problem, B, r)
    z, C = _mode(B, r)
    active = np.zeros(problem.T.shape[1], int)
    if problem.lower is not None:
        z, active = limited(problem, z, C)

    def root() -> np.ndarray:
        """L C^-1, given that the properties at their limits stay there."""
        return problem.expand(conditioned(problem, np.linalg.inv(C), active))

    return LinearEstimate(problem.expand(z), z, root)


def _mode(B: np.ndarray, r: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """z (k,) that minimises |r - B z|^2 + |z|^2; C (k, k), upper triangular, with C'C = I + B'B."""
    q, k = B.shape
    gram = B.T @ B
    if gram.diagonal().max(initial=0.0) > _LARGE**2:
        stacked = np.zeros((q + k, k + 1))
        stacked[:q, :k], stacked[:q, k], stacked[q:, :k] = B, r, np.eye(k)
        C = np.linalg.qr(stacked, mode="r")[:k]
        return _triangular(C[:, :k], C[:, k]), C[:, :k]
    gram[np.diag_indices(k)] += 1.0
    C = np.linalg.cholesky(gram).T
    return _triangular(C, _triangular(C.T, B.T @ r, lower=True)), C


def _triangular(C: np.ndarray, right: np.ndarray, lower: bool = False) -> np.ndarray:
    """C^-1 `right` for triangular C; scipy, which knows of triangles, takes longer to load than small ones to solve."""
    if len(C) < _WORTH_LOADING:
        return np.linalg.solve(C, right)
    from scipy.linalg import solve_triangular

    return solve_triangular(C, right, lower=lower)


def _definite(gram: np.ndarray, right: np.ndarray) -> np.ndarray:
    """gram^-1 `right` for positive definite gram, which is overwritten."""
    if len(gram) < _WORTH_LOADING:
        return np.linalg.solve(gram, right)
    from scipy.linalg import cho_factor, cho_solve

    return cho_solve(cho_factor(gram, overwrite_a=True, check_finite=False), right, check_finite=False)


def _nearest(B: np.ndarray, r: np.ndarray) -> np.ndarray:
    """z = B'(I + B B')^-1 r (k,), by orthogonal vectors where I + B B' would lose digits."""
    gram = B @ B.T
    if gram.diagonal().max(initial=0.0) > _LARGE**2:
        Q, F = np.linalg.qr(B.T)
        return Q @ _mode(F.T, r)[0]
    gram[np.diag_indices(len(gram))] += 1.0
    return B.T @ _definite(gram, r)


def _within_row_space(problem: LinearProblem, B: np.ndarray, r: np.ndarray) -> LinearEstimate:
    """Fewer data than properties: z = B'(I + B B')^-1 r. With B' = Q F, Q (k, q), only Q'z is revised; I - Q Q' stays as it was.

    Variances are sums of squares, so that what accurate data leave of them keeps its digits.
    """

    @cache
    def parts() -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """L Q, Q and C: only who asks for variances needs them."""
        Q, F = np.linalg.qr(B.T)
        return problem.expand(Q), Q, _mode(F.T, r)[1]

    z = _nearest(B, r)

    def narrow() -> np.ndarray:
        """L Q C^-1 (p, q): T L (I - Q Q') = 0."""
        seen, _, C = parts()
        return seen @ np.linalg.inv(C)

    def root() -> np.ndarray:
        """[L Q C^-1, L (I - Q Q')]."""
        Q = parts()[1]
        return np.hstack([narrow(), problem.expand(np.eye(len(z)) - Q @ Q.T)])

    def variances() -> np.ndarray:
        """Row sums of squares of the root, without the second block where a difference does as well."""
        revised, (seen, Q, _) = narrow(), parts()
        prior = problem.L**2 if problem.L.ndim == 1 else np.sum(problem.L**2, axis=1)
        unseen = prior - np.sum(seen * seen, axis=1)
        small = np.flatnonzero(unseen < _SEEN * prior)  # at most about q of them
        rows = problem.L[small, None] * np.eye(len(z))[small] if problem.L.ndim == 1 else problem.L[small]
        unseen[small] = np.sum((rows - seen[small] @ Q.T) ** 2, axis=1)
        return unseen + np.sum(revised * revised, axis=1)

    return LinearEstimate(problem.expand(z), z, root, variances, narrow)


ESTIMATOR = Estimator(
    "bayes",
    "Bayes",
    "x* = x_p + S T'(R + T S T')^-1 (y - T x_p); S* = S - S T'(R + T S T')^-1 T S",
    True,
    True,
    solve,
)
