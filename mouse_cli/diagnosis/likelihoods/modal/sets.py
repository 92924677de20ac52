"""Motions that a structure without one of its element sets has, and that few coordinates of the whole one would not hold."""

import numpy as np

from mouse_cli.dynamics.eigen import IndefiniteError
from mouse_cli.dynamics.solver import EigenSolver
from mouse_cli.model.arrays import Matrix
from mouse_cli.model.problem import Problem

MOST_OF_SETS = 120  # coordinates for them
_GONE = 0.95  # share of a set that is taken away: its own motions stay finite
_MISSING = (
    1 - 1e-6
)  # share of a set that is taken away with its mass: its own motions keep their frequencies, and stay finite
_LEFT = 1e-6  # of the A-norm of a motion: what is left of it beside the space, below which it is in it


def without_sets(
    problem: Problem, K: Matrix, M: Matrix, sigma: float, V: np.ndarray, last: int
) -> tuple[np.ndarray, np.ndarray]:
    """Motions X (c, n) and A X, A = K - sigma M: of the lowest `last` modes without each set what V (d, n), V A V' = I, leaves.

    Of each set those combinations with the largest A-norm: between them and the modes of the whole, a set that is softer in any
    share moves as a Ritz vector does that is right to second order at both ends. A set with mass is taken away once in part, and
    once as a whole.
    """
    n, each = K.shape[0], max(2, MOST_OF_SETS // (2 * len(problem.groups)))
    found, loads = [np.zeros((0, n))], [np.zeros((0, n))]
    for group in problem.groups[: MOST_OF_SETS // (2 * each)]:
        own = [within(problem, matrix) for matrix in (group.K, group.M)]
        for X in _modes_without(K, M, own, last):
            rows, forces = _apart(X, lambda x: (K @ x.T - sigma * (M @ x.T)).T, V, each)
            found.append(rows)
            loads.append(forces)
    return np.concatenate(found), np.concatenate(loads)


def _modes_without(K: Matrix, M: Matrix, own: list[Matrix | None], last: int) -> list[np.ndarray]:
    """Modes X (m, n) without a set that gives `own` to K and M: the most of it, and all of it if it has mass."""
    found = []
    for gone in () if own[0] is None else (_GONE,) if own[1] is None else (_GONE, _MISSING):
        lighter = M if own[1] is None else M - gone * own[1]
        try:
            found.append(EigenSolver().solve((K - gone * own[0]).tocsr(), lighter.tocsr(), last).shapes[:, :last].T)
        except (IndefiniteError, np.linalg.LinAlgError):
            continue
    return found


def _apart(X: np.ndarray, A, V: np.ndarray, most: int) -> tuple[np.ndarray, np.ndarray]:
    """At most `most` combinations of the rows of X (m, n) less their part in V, and A times them."""
    AX = A(X)
    whole = np.einsum("mn,mn->m", X, AX)
    X = X - (AX @ V.T) @ V
    X, AX = X / np.sqrt(whole)[:, None], A(X) / np.sqrt(whole)[:, None]
    size, Q = np.linalg.eigh(X @ AX.T)
    kept = np.flatnonzero(size > _LEFT**2)[::-1][:most]
    scale = (Q[:, kept] / np.sqrt(size[kept])).T
    return np.ascontiguousarray(scale @ X), np.ascontiguousarray(scale @ AX)


def within(problem: Problem, matrix: Matrix | None) -> Matrix | None:
    """The matrix of a set in the degrees of freedom of the model, those that were added since among them."""
    if matrix is None:
        return None
    own = matrix if problem.held is None else matrix[problem.held.kept][:, problem.held.kept]
    wide = problem.structure.n - own.shape[0]
    if not wide:
        return own
    from scipy.sparse import block_diag, csr_array

    return csr_array(block_diag([own, csr_array((wide, wide))]))
