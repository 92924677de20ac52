"""Motions that a structure without one of its element sets has, and that few coordinates of the whole one would not hold."""

from dataclasses import dataclass

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
_KEPT = 3  # coordinates: the coarse ones of a first look, and all of them, at two parameters of a small model
_FOLLOWS = 1e-6  # relative error up to which what a parameter does is that of whole sets


@dataclass(frozen=True)
class SetsIn:
    """What each of g sets gives to K or M: stored (n, n), projected (r, r) on coordinates V; None where it gives nothing.

    slopes (p, g): how its share grows with each parameter. What parameter j does is sum_s a_js X_s where it is that of whole
    sets; X_s is then (1 + sum_j a_js (theta_j - nominal_j)) X_s.
    """

    V: np.ndarray
    stored: list[Matrix | None]
    projected: list[np.ndarray | None]
    slopes: np.ndarray

    def factors(self, model: Reduced) -> np.ndarray:
        """The share (g,) of each that is there at the parameters of the model."""
        return 1 + (model.theta - np.array([each.nominal for each in model.problem.parameters])) @ self.slopes


def sets_in(model: Reduced, name: str) -> SetsIn:
    """What the sets give to K or M (`name`); the same at all parameters, and kept for the last coordinates that asked."""
    kept: list[SetsIn] = model.built_once.setdefault(("sets", name), [])
    found = next((each for each in kept if each.V is model.V), None)
    if found is None:
        stored = [within(model.problem, getattr(group, name)) for group in model.problem.groups]
        projected = [None if each is None else model.project(each) for each in stored]
        found = SetsIn(model.V, stored, projected, _following(model, model.dK if name == "K" else model.dM, projected))
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

    Of each set those combinations with the largest A-norm: between them and the modes of the whole, a set that is softer in any
    share moves as a Ritz vector does that is right to second order at both ends. A set with mass is taken away once in part, and
    once as a whole.
    """
    problem, sets = model.problem, [sets_in(model, name) for name in "KM"]
    factors = [each.factors(model) for each in sets]
    n, each = K.shape[0], max(2, MOST_OF_SETS // (2 * len(problem.groups)))
    found, loads = [np.zeros((0, n))], [np.zeros((0, n))]
    for i in range(min(len(problem.groups), MOST_OF_SETS // (2 * each))):
        stored = [one.stored[i] for one in sets]
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
