"""Directions in which the parameters of a deck move a model: all of them, or those that the data see where there are many."""

from dataclasses import dataclass, replace

import numpy as np

from mouse_cli.diagnosis.likelihoods.modal.data import Data
from mouse_cli.dynamics.contraction import Stack
from mouse_cli.dynamics.sensing import read
from mouse_cli.model.problem import Problem
from mouse_cli.terms.assembly import Assembly
from mouse_cli.updating.coordinates import Coordinates, coordinates

ALL = 60  # parameters up to which each is a direction of its own
_MOST = 40  # directions that are kept when there are more
_ROWS, _PROPERTIES = 8192, 64  # worked on at once


@dataclass(frozen=True)
class Directions:
    """values (p, k): what one unit of each direction adds to the parameters; coordinates: with the root L of their prior.

    L (p, k') of the coordinates spans what may vary; prior (p, k') = d(parameters)/dz there.
    """

    values: np.ndarray
    coordinates: Coordinates
    prior: np.ndarray


def directions(
    problem: Problem, total: Assembly, theta: np.ndarray, stack: Stack, V: np.ndarray, eigenvalues: np.ndarray
) -> Directions:
    """At theta (p,), for a model with coordinates V (n, r).

    Of more than ALL parameters: the right singular vectors of R^-1/2 T L, T derivatives of the data; what the prior leaves
    uncertain beside them moves no datum, and stays where it is.
    """
    at = coordinates(problem, total)
    L = np.diag(at.L) if at.L.ndim == 1 else at.L
    u = np.where(at.logarithmic, np.log(np.maximum(theta, 1e-300)), theta)
    by = at.slope(u)[:, None] * L
    if L.shape[1] <= ALL:
        return Directions(np.eye(len(theta)), at, by)
    D = np.linalg.svd(_partials(problem, stack, V, eigenvalues) @ by, full_matrices=False)[2][:_MOST].T
    z = np.linalg.lstsq(L, u - at.mean, rcond=None)[0]
    held = L @ (z - D @ (D.T @ z))
    return Directions(by @ D, replace(at, L=L @ D, mean=at.mean + held), by @ D)


def _partials(problem: Problem, stack: Stack, V: np.ndarray, eigenvalues: np.ndarray) -> np.ndarray:
    """Derivatives (q, p) of the whitened data by the parameters, in the coordinates V."""
    data = Data(problem.test, problem.theory)
    seen = np.asarray(read(problem.test.measured_at, V))
    modes = data.pair(eigenvalues, seen)
    _, a = data.residual(eigenvalues[modes], seen[:, modes])
    shapes = np.ascontiguousarray(V[:, modes])
    m, p = len(modes), stack.p
    apart = eigenvalues[modes] - eigenvalues[:, None]
    apart[np.abs(apart) < 1e-9 * np.abs(eigenvalues[modes])] = np.inf
    d_lambda, d_seen = np.zeros((m, p)), np.zeros((len(seen), m, p))
    for first, last in stack.chunks(_ROWS, _PROPERTIES):
        force, inertia = stack.forces(first, last, shapes, eigenvalues[modes])
        for j in range(first, last):
            own = slice(stack.start[j] - stack.start[first], stack.start[j + 1] - stack.start[first])
            rows = stack.rows[stack.start[j] : stack.start[j + 1]]
            G = V[rows].T @ force[own]
            d_lambda[:, j] = G[modes, np.arange(m)]
            d_seen[:, :, j] = seen @ (G / apart)
            if inertia is not None:
                d_seen[:, :, j] -= 0.5 * seen[:, modes] * np.einsum("tm,tm->m", shapes[rows], inertia[own])
    return data.jacobian(eigenvalues[modes], seen[:, modes], a, d_lambda, d_seen)


def projected(stack: Stack, by: np.ndarray, V: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """V' dK V and V' dM V (k, r, r), dK and dM the derivatives along the directions `by` (p, k)."""
    from mouse_cli.dynamics.contraction import rows_of

    (_, k), r = by.shape, V.shape[1]
    found = np.zeros((2, k, r, r))
    for first, last in stack.chunks(_ROWS, _PROPERTIES):
        rows = slice(stack.start[first], stack.start[last])
        for out, matrix in zip(found, (stack.K, stack.M), strict=True):
            if not matrix.nnz:
                continue
            force = rows_of(matrix, rows) @ V
            for j in range(first, last):
                own = slice(stack.start[j] - rows.start, stack.start[j + 1] - rows.start)
                if own.stop > own.start:
                    part = V[stack.rows[rows][own]].T @ force[own]
                    for i in np.flatnonzero(by[j]):
                        out[i] += by[j, i] * part
    return found[0], found[1]
