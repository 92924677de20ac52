"""Motions that a structure without one of its element sets has, and that few coordinates of the whole one would not hold."""

import numpy as np

from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
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
_FOLLOWS = 1e-6  # relative error up to which what a parameter does is that of whole sets


def following(model: Reduced, name: str) -> tuple[np.ndarray, np.ndarray]:
    """How the share (p, g) of each set in K or M (`name`) grows with each parameter, and (g,) what it is at those of the model.

    What parameter j does is sum_s a_js X_s where it is that of whole sets; X_s is then (1 + sum_j a_js (theta_j - nominal_j)) X_s.
    """
    parameters, slopes = model.problem.parameters, model.dK if name == "K" else model.dM
    stored = [within(model.problem, getattr(group, name)) for group in model.problem.groups]
    there = [i for i, each in enumerate(stored) if each is not None]
    a = np.zeros((len(parameters), len(stored)))
    if there and len(parameters):
        blocks = np.array([model.project(stored[i]).ravel() for i in there])
        sizes = np.linalg.norm(blocks, axis=1).clip(1e-300)
        blocks /= sizes[:, None]
        does = model.along.T @ slopes.reshape(len(slopes), -1)
        found = np.linalg.lstsq(blocks.T, does.T, rcond=None)[0].T
        error = np.linalg.norm(does - found @ blocks, axis=1)
        a[:, there] = np.where((error <= _FOLLOWS * np.linalg.norm(does, axis=1))[:, None], found / sizes, 0.0)
    return a, 1 + (model.theta - np.array([each.nominal for each in parameters])) @ a


def without_sets(
    model: Reduced, K: Matrix, M: Matrix, sigma: float, V: np.ndarray, last: int
) -> tuple[np.ndarray, np.ndarray]:
    """Motions X (c, n) and A X, A = K - sigma M: of the lowest `last` modes without each set what V (d, n), V A V' = I, leaves.

    Of each set those combinations with the largest A-norm: between them and the modes of the whole, a set that is softer in any
    share moves as a Ritz vector does that is right to second order at both ends. A set with mass is taken away once in part, and
    once as a whole.
    """
    problem, factors = model.problem, [following(model, name)[1] for name in "KM"]
    n, each = K.shape[0], max(2, MOST_OF_SETS // (2 * len(problem.groups)))
    found, loads = [np.zeros((0, n))], [np.zeros((0, n))]
    for i, group in enumerate(problem.groups[: MOST_OF_SETS // (2 * each)]):
        stored = [within(problem, matrix) for matrix in (group.K, group.M)]
        own = [None if one is None else of[i] * one for one, of in zip(stored, factors, strict=True)]
        for X in _modes_without(K, M, own, last):
            rows, forces = _apart(X, lambda x: (K @ x.T - sigma * (M @ x.T)).T, V, each)
            found.append(rows)
            loads.append(forces)
    return np.concatenate(found), np.concatenate(loads)


def _modes_without(K: Matrix, M: Matrix, own: list[Matrix | None], last: int) -> list[np.ndarray]:
    """Modes X (m, n) without a set that gives `own` to K and M: the most of it, and all of it if it has mass."""
    from scipy.sparse import csr_array

    found = []
    for gone in () if own[0] is None else (_GONE,) if own[1] is None else (_GONE, _MISSING):
        lighter = M if own[1] is None else M - gone * own[1]
        try:
            softer, lighter = csr_array(K - gone * own[0]), csr_array(lighter)
            found.append(EigenSolver().solve(softer, lighter, last).shapes[:, :last].T)
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
