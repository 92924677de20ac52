"""Motions that a structure without one of its element sets has, and that few coordinates of the whole one would not hold."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.dynamics.eigen import IndefiniteError
from mouse_cli.dynamics.solver import EigenSolver
from mouse_cli.model.arrays import Matrix
from mouse_cli.model.problem import Problem

MOST_OF_SETS = 180  # coordinates for them
MOST_OF_SEVERAL = 40  # and for those without several at once
MISSING = (1 - 1e-6, 1 - 1e-9)  # shares of K and M of a set: its own motions stay finite, far above those of the rest
_STATES = (  # such shares that are taken away, those that matter most first
    MISSING,
    (0.95, 0.0),  # soft and as heavy as it was: its own motions are among the lowest
    (0.8, 0.8),
)
_SHORT = 0.5  # error of a frequency, in its sd, that is no matter
_KEPT = 3  # coordinates: the coarse ones of a first look, and all of them, at two parameters of a small model
_FOLLOWS = 1e-6  # relative error up to which what a parameter does is that of whole sets


@dataclass(frozen=True)
class SetsIn:
    """What each of g sets gives to K or M: stored (n, n), projected (r, r) on coordinates V; None where it gives nothing.

    missing, less: what is lost without it, likewise; None where that is what it gives.
    slopes (p, g): how its share grows with each parameter. What parameter j does is sum_s a_js X_s where it is that of whole
    sets; X_s is then (1 + sum_j a_js (theta_j - nominal_j)) X_s.
    """

    V: np.ndarray
    stored: list[Matrix | None]
    projected: list[np.ndarray | None]
    slopes: np.ndarray
    missing: list[Matrix | None]
    less: list[np.ndarray | None]

    def factors(self, model: Reduced) -> np.ndarray:
        """The share (g,) of each that is there at the parameters of the model."""
        return 1 + (model.theta - np.array([each.nominal for each in model.problem.parameters])) @ self.slopes


def sets_in(model: Reduced, name: str) -> SetsIn:
    """What the sets give to K or M (`name`); the same at all parameters, and kept for the last coordinates that asked."""
    kept: list[SetsIn] = model.built_once.setdefault(("sets", name), [])
    found = next((each for each in kept if each.V is model.V), None)
    if found is None:
        stored = [within(model.problem, getattr(group, name)) for group in model.problem.groups]
        missing = [within(model.problem, (each.missing or (None, None))["KM".index(name)]) for each in model.problem.groups]
        projected, less = ([None if x is None else model.project(x) for x in each] for each in (stored, missing))
        slopes = _following(model, model.dK if name == "K" else model.dM, projected)
        found = SetsIn(model.V, stored, projected, slopes, missing, less)
    kept[:] = [found, *(each for each in kept if each is not found)][:_KEPT]
    return found


def _following(model: Reduced, slopes: np.ndarray, projected: list[np.ndarray | None]) -> np.ndarray:
    """How the share (p, g) of each set grows with each parameter; 0 where what that does is not that of whole sets."""
    there = [i for i, each in enumerate(projected) if each is not None]
    a = np.zeros((len(model.problem.parameters), len(projected)))
    if there and len(a):
        blocks = np.array([projected[i].ravel() for i in there])
        sizes = np.linalg.norm(blocks, axis=1).clip(1e-300)
        blocks /= sizes[:, None]
        does = model.along.T @ slopes.reshape(len(slopes), -1)
        found = np.linalg.lstsq(blocks.T, does.T, rcond=None)[0].T
        error = np.linalg.norm(does - found @ blocks, axis=1)
        a[:, there] = np.where((error <= _FOLLOWS * np.linalg.norm(does, axis=1))[:, None], found / sizes, 0.0)
    return a


def without_sets(
    model: Reduced, K: Matrix, M: Matrix, sigma: float, V: np.ndarray, last: int
) -> tuple[np.ndarray, np.ndarray]:
    """Motions X (c, n) and A X, A = K - sigma M: of the lowest `last` modes without each set what V (d, n), V A V' = I, leaves.

    Of all sets those that eigenvalues want most: between them and the modes of the whole, a set that is softer in any share moves
    as a Ritz vector does that is right to second order at both ends. A set is taken away in part, with its mass and without, for
    one that is soft and heavy has low modes of its own, and as a whole.
    """
    problem, of = model.problem, [sets_in(model, name) for name in "KM"]
    factors, least = [each.factors(model) for each in of], _least(model)
    found: list[tuple[int, float, np.ndarray]] = []
    for i in range(len(problem.groups)):
        given, whole = ([each.stored[i] for each in of], [each.missing[i] for each in of])
        whole = given if whole[0] is None else whole
        own, all_ = ([None if x is None else by[i] * x for x, by in zip(each, factors, strict=True)] for each in (given, whole))
        blocks = [V]
        for rank, gone in enumerate(_STATES if own[0] is not None else ()):
            if not any(gone[1:]) or own[1] is not None:
                lost = [
                    None if each is None or not share else share * each
                    for share, each in zip(gone, all_ if rank == 0 else own, strict=True)
                ]
                size, rows = _apart(K, M, sigma, lost, blocks, last, least)
                found += [(rank, -error, row) for error, row in zip(size.tolist(), rows, strict=True)]
                blocks.append(rows)
        found = sorted(found, key=lambda each: each[:2])[:MOST_OF_SETS]
    X = np.array([row for *_, row in found]).reshape(len(found), K.shape[0])
    return X, _energetic(K, M, sigma, X)


def without_several(
    model: Reduced, K: Matrix, M: Matrix, sigma: float, V: np.ndarray, last: int, sets: Sequence[tuple[int, ...]]
) -> tuple[np.ndarray, np.ndarray]:
    """The same of the modes without several sets at once, by their numbers."""
    of, blocks = [sets_in(model, name) for name in "KM"], [V]
    for numbers in sets:
        lost = [
            share * sum(by[i] * (each.stored[i] if of[0].missing[i] is None else each.missing[i]) for i in numbers)
            for share, each, by in zip(MISSING, of, (each.factors(model) for each in of), strict=True)
        ]
        blocks.append(_apart(K, M, sigma, lost, blocks, last, _least(model))[1])
    X = np.concatenate(blocks[1:] or [np.zeros((0, K.shape[0]))])[:MOST_OF_SEVERAL]
    return X, _energetic(K, M, sigma, X)


def _least(model: Reduced) -> float:
    """Relative error of an eigenvalue that matters beside the most accurate frequency of the test."""
    return 2 * _SHORT * float(model.data.sd_log.min())


def _energetic(K: Matrix, M: Matrix, sigma: float, X: np.ndarray) -> np.ndarray:
    """(K - sigma M) X (m, n), row by row."""
    return np.ascontiguousarray((K @ X.T - sigma * (M @ X.T)).T)


def _apart(
    K: Matrix, M: Matrix, sigma: float, lost: list[Matrix | None], blocks: list[np.ndarray], last: int, least: float
) -> tuple[np.ndarray, np.ndarray]:
    """What motions `blocks` (each (c, n), orthonormal in A) leave of the modes without `lost` of K and M: combinations X (m, n),
    orthonormal in A beside them, by which eigenvalues are too high by more than `least`, relative, and that error (m,).

    It is what they leave in the norm of A without what is lost (Galerkin): there the motions are I - V D V', D = what is lost.
    """
    from scipy.sparse import csr_array

    D = lost[0] if lost[1] is None else lost[0] - sigma * lost[1]
    try:
        softer, lighter = csr_array(K - lost[0]), csr_array(M if lost[1] is None else M - lost[1])
        X = EigenSolver().solve(softer, lighter, last).shapes[:, :last].T
    except (IndefiniteError, np.linalg.LinAlgError):
        return np.zeros(0), np.zeros((0, K.shape[0]))
    at = np.flatnonzero(np.diff(csr_array(D).indptr))
    near = np.concatenate([each[:, at] for each in blocks])
    soft = lambda X: _energetic(softer, lighter, sigma, X)
    AX = soft(X)
    X, AX = (each / np.sqrt(np.einsum("mn,mn->m", X, AX))[:, None] for each in (X, AX))
    onto = np.concatenate([each @ AX.T for each in blocks])
    X = _less(X, np.linalg.solve(np.eye(len(near)) - near @ (csr_array(D)[at][:, at] @ near.T), onto), blocks)
    size, Q = np.linalg.eigh(X @ soft(X).T)
    kept = np.flatnonzero(size > least)[::-1]
    X = Q[:, kept].T @ X
    X = _less(X, np.concatenate([each @ _energetic(K, M, sigma, X).T for each in blocks]), blocks)
    R = np.linalg.cholesky(X @ _energetic(K, M, sigma, X).T) if len(X) else np.eye(0)
    return size[kept], np.linalg.solve(R, X)


def _less(X: np.ndarray, by: np.ndarray, blocks: list[np.ndarray]) -> np.ndarray:
    """X (m, n) less its parts `by` (d, m) along all of `blocks`."""
    ends = np.cumsum([0, *(len(each) for each in blocks)])
    return X - sum(by[i:j].T @ each for i, j, each in zip(ends[:-1], ends[1:], blocks, strict=True))


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
