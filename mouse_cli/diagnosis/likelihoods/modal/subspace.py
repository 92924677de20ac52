"""The baseline of a large model in at most some hundred and fifty coordinates.

Ritz vectors from what the eigensolver has already: its lowest modes and half as many of its Lanczos vectors besides; A^-1 L for
loads L, A = K - sigma M by the factorisation that is there: unit loads at sensors, forces that the parameters put on the measured
modes, and unit loads where a force that the model lacks may act. With A^-1 S' and A^-1 B in the space, S R(lambda) B is exact at
lambda = sigma, twice over (Galerkin), and what is left of it elsewhere is of second order in lambda over the modes left out; where
there is room, A^-1 M A^-1 S' makes it of the fourth.
"""

from dataclasses import replace

import numpy as np

from mouse_cli.diagnosis.likelihoods.modal.absent import absent_together
from mouse_cli.diagnosis.likelihoods.modal.directions import directions
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced, built
from mouse_cli.diagnosis.likelihoods.modal.sets import MOST_OF_SETS, MOST_OF_SEVERAL, without_sets, without_several
from mouse_cli.diagnosis.localise.force import matched
from mouse_cli.diagnosis.localise.heavier import MOST as MOST_OF_NODES
from mouse_cli.diagnosis.localise.heavier import heavier
from mouse_cli.diagnosis.localise.matching import Matcher, shapes
from mouse_cli.diagnosis.localise.survey import survey
from mouse_cli.diagnosis.sites.residual import static
from mouse_cli.diagnosis.sites.sheared import shearing
from mouse_cli.dynamics.contraction import Stack
from mouse_cli.dynamics.krylov import Krylov
from mouse_cli.dynamics.lanczos import INFINITE
from mouse_cli.dynamics.sensing import unit_loads
from mouse_cli.dynamics.solver import EigenSolver
from mouse_cli.model.arrays import Matrix
from mouse_cli.model.problem import Problem
from mouse_cli.terms.assembly import Assembly
from mouse_cli.updating.state import solve

_MOST = 150  # coordinates
_MODES = 70  # of them at most from the eigensolver
_MOVED = 30  # responses to what the parameters do
_PLACES = 40  # degrees of freedom where a force may act
_CLOSER = 4  # one in so many of them about the best of the others
_EACH, _COLUMNS = 20_000, 32  # degrees of freedom, and vectors, worked on at once


class Basis:
    """Vectors V with V'AV = I, grown by responses to loads; theta and combinations S of them diagonalise V'MV."""

    def __init__(self, K: Matrix, M: Matrix, problem: Problem, solver: EigenSolver | None = None):
        last = int(problem.test.number.max())
        solution = solve(problem, K, M, solver=solver)
        self.solution, self.full = solution, solution.space is None
        if self.full:
            return
        self.sigma, operator = solution.shift, solution.space.operator
        theta, S, _ = solution.space.ritz()
        kept = min(max(last + 10, 3 * (last + 10) // 2, 30), _MODES, int((theta > INFINITE * theta[0]).sum()))
        modes = S[:, :kept].T @ solution.space.V[: solution.space.reached]
        self.space = Krylov(operator, _MOST + 20 + MOST_OF_NODES + (MOST_OF_SETS + MOST_OF_SEVERAL if problem.groups else 0))
        self.space.append(modes, np.ascontiguousarray((K @ modes.T - self.sigma * (M @ modes.T)).T))
        self._T = np.zeros((0, 0))
        self.responses(np.zeros((K.shape[0], 0)))

    @property
    def free_vectors(self) -> int:
        """Vectors that may still be added."""
        return _MOST - self.space.d

    def responses(self, loads: np.ndarray) -> None:
        """Add A^-1 `loads` (n, c)."""
        rows = np.ascontiguousarray(loads.T)
        self.motions(self.space.operator.solve(rows) if len(rows) else rows, rows)

    def motions(self, rows: np.ndarray, loads: np.ndarray) -> None:
        """Add motions `rows` (c, n), with A times each in `loads` (c, n)."""
        before = len(self._T)
        if len(rows):
            self.space.append(rows, loads)
        V = self.space.V
        new = V @ self.space.operator.mass(V[before:]).T
        T = np.zeros((len(V), len(V)))
        T[:before, :before] = self._T
        T[:, before:], T[before:] = new, new.T
        self._T = T

    def inertia(self, loads: np.ndarray) -> np.ndarray:
        """M A^-1 `loads` (n, c): responses to them are what the first ones leave of R, in the next order of lambda."""
        operator = self.space.operator
        return operator.mass(operator.solve(np.ascontiguousarray(loads.T))).T

    def ritz(self) -> tuple[np.ndarray, np.ndarray]:
        """V (n, r) with V'MV = I, and eigenvalues (r,)."""
        if self.full:
            return self.solution.shapes[:, :_MOST], self.solution.eigenvalues[:_MOST]
        theta, S = np.linalg.eigh(self._T)
        kept = np.flatnonzero(theta > INFINITE * theta[-1])[::-1]
        return np.ascontiguousarray(((S[:, kept] / np.sqrt(theta[kept])).T @ self.space.V).T), self.sigma + 1 / theta[
            kept
        ]

    def orthonormal(self, K: Matrix) -> tuple[np.ndarray, np.ndarray]:
        """The same with V'MV = I and V'KV diagonal to rounding, of which no more than what a member or an element set gives may be
        left where that is missing.
        """
        from scipy.linalg import eigh

        V, mass = self.ritz()[0], self.space.operator.mass
        blocks = [slice(first, first + _COLUMNS) for first in range(0, V.shape[1], _COLUMNS)]
        stiff = np.hstack([V.T @ (K @ V[:, own]) for own in blocks])
        heavy = np.hstack([V.T @ mass(V[:, own].T).T for own in blocks])
        eigenvalues, S = eigh((stiff + stiff.T) / 2, (heavy + heavy.T) / 2)
        return V @ S, eigenvalues


def large(
    problem: Problem, total: Assembly, K: Matrix, M: Matrix, theta: np.ndarray, solver: EigenSolver | None = None
) -> Reduced:
    """The reduced model of K and M (n, n) at theta (p,), and the places that candidates look at."""
    from scipy.sparse import csr_array

    basis = Basis(csr_array(K), csr_array(M), problem, solver)
    stack = Stack(total.n, total.p, total.slopes(theta))
    if not basis.full:
        at, values = unit_loads(problem.test.measured_at)
        basis.responses(_placed(total.n, at, values))
    by = directions(problem, total, theta, stack, *basis.ritz())
    if basis.full:
        return built(problem, total, theta, *basis.ritz(), by, stack)
    last = int(problem.test.number.max())
    basis.responses(_moved(basis, stack, by.prior, last))
    basis.responses(shearing(problem, theta, basis.ritz()[0][:, : min(last, basis.free_vectors)]))
    if problem.test.s and basis.free_vectors >= _PLACES + problem.test.s:
        basis.responses(basis.inertia(_placed(total.n, at, values)))
    model = built(problem, total, theta, *basis.ritz(), by, stack)
    room = min(_PLACES, basis.free_vectors)
    places = survey(model, K, room - room // _CLOSER)
    basis.responses(_placed(total.n, places, np.eye(len(places))))
    if len(places):
        model = built(problem, total, theta, *basis.ritz(), by, stack)
        more = _closer(model, places, room // _CLOSER)
        basis.responses(_placed(total.n, more, np.eye(len(more))))
        places = np.concatenate([places, more])
        beside = heavier(model, places)
        basis.responses(_placed(total.n, beside, np.eye(len(beside))))
        places = np.concatenate([places, beside])
    if problem.groups:
        basis.motions(*without_sets(model, K, M, basis.sigma, basis.space.V, last))
    model = built(problem, total, theta, *basis.orthonormal(K), by, stack)
    if several := absent_together(model):
        basis.motions(*without_several(model, K, M, basis.sigma, basis.space.V, last, several))
        model = built(problem, total, theta, *basis.orthonormal(K), by, stack)
    lowest = model.V[:, : min(model.r, last + 2)]
    by_all = static(problem, model.motion, model.bars, basis.sigma, basis.space.operator.columns, lowest)
    return replace(model, places=np.sort(places), static=by_all)


def _closer(model: Reduced, places: np.ndarray, count: int) -> np.ndarray:
    """`count` more degrees of freedom that match as well as the best of `places`, at the parameters that this one wants.

    A survey leaves out what its looks could not tell from a place that it took.
    """
    measured = shapes(model)
    tried = matched(model, measured, model.V[places])
    matcher = Matcher(model, measured, tried.z[np.argmin(tried.cost)])
    parts = [model.V[i : i + _EACH] @ matcher.X for i in range(0, len(model.V), _EACH)]
    misfit = np.concatenate([sum(matcher.nearest(i, B)[1] for i in range(len(measured.modes))) for B in parts])
    misfit[places] = np.inf
    return np.argsort(misfit, kind="stable")[:count]


def _placed(n: int, at: np.ndarray, values: np.ndarray) -> np.ndarray:
    loads = np.zeros((n, values.shape[1]))
    loads[at] = values
    return loads


def _moved(basis: Basis, stack: Stack, by: np.ndarray, last: int) -> np.ndarray:
    """Loads (n, c): what the directions `by` (p, k) of the parameters put on the lowest modes, each, or mixed when they are many.

    A random mixture of all of them spans what most of them do (Halko, Martinsson and Tropp 2011).
    """
    count = min(last, len(basis.solution.eigenvalues))
    shapes = np.ascontiguousarray(basis.solution.shapes[:, :count])
    k = by.shape[1]
    mixed = np.random.default_rng(0).standard_normal((k, count, _MOVED)) if k * count > _MOVED else None
    loads = np.zeros((basis.space.n, _MOVED if mixed is not None else k * count))
    for first, final in stack.chunks(8192, 64):
        rows = slice(stack.start[first], stack.start[final])
        own = np.repeat(np.arange(first, final), np.diff(stack.start[first : final + 1]))
        force, _ = stack.forces(first, final, shapes, basis.solution.eigenvalues[:count])
        if mixed is None:
            part = (force[:, :, None] * by[own][:, None, :]).reshape(len(own), -1)
        else:
            weights = np.tensordot(by[first:final], mixed, 1)
            part = np.concatenate(
                [
                    force[stack.start[j] - stack.start[first] : stack.start[j + 1] - stack.start[first]]
                    @ weights[j - first]
                    for j in range(first, final)
                ]
            )
        np.add.at(loads, stack.rows[rows], part)
    return loads[:, np.abs(loads).max(axis=0) > 0]
