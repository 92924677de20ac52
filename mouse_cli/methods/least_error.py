"""Equation error: properties that leave the least force (K - lambda M) x of the measured modes, support of the methods that do so.

Forces are measured by the energy they would put into the structure, r'(K0 + s M)^-1 r with s the lowest measured eigenvalue, so
that neither units nor the fineness of the mesh count, and each mode by lambda M x likewise.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from mouse_cli.estimators.conditioning import conditioning
from mouse_cli.estimators.linear import LinearProblem
from mouse_cli.methods.acceleration import Accelerated
from mouse_cli.methods.given import MOST_ITERATIONS, SETTLED, Given
from mouse_cli.model.arrays import Matrix
from mouse_cli.model.conditioning import Conditioning
from mouse_cli.model.term import Slopes
from mouse_cli.terms.assembly import Assembly

_RANK = 1e-12  # of the largest eigenvalue of the normal equations
_HALVINGS = 30
_STILL = 1e-8  # change, in units of the parameters, with which it ends: the last steps are few
_PATIENCE = 8  # iterations without progress after which rounding has the last word


class Undetermined(ArithmeticError):
    """The equations leave some combination of the unknowns open; `loose` (k,) marks those that take part in it."""

    def __init__(self, rank: int, loose: np.ndarray):
        super().__init__(f"of {len(loose)} unknowns only {rank} follow from the equations")
        self.loose = loose


@dataclass(frozen=True)
class Unknowns:
    """Which parameters (k,) of `assembly` are sought, in which units (k,), from `theta` (p,); admissible(theta): may they be so."""

    assembly: Assembly
    theta: np.ndarray
    free: np.ndarray
    units: np.ndarray
    admissible: Callable[[np.ndarray], bool]


@dataclass(frozen=True)
class Fitted:
    """theta (p,), K, M there, how they were reached, and the bounds of the last least-squares answer."""

    theta: np.ndarray
    K: Matrix
    M: Matrix
    iterations: int
    change: float
    settled: bool
    conditioning: Conditioning | None


def least_error(given: Given, unknowns: Unknowns) -> Fitted:
    """The lecture's two sub-steps until the unknowns settle: K expands the shapes, shapes give the unknowns by least squares.

    A step that would leave what is admissible is halved until it does not. Raises Undetermined.
    """
    theta, inverse, ahead, iteration = unknowns.theta.copy(), given.energies(), Accelerated(), 0
    best, since = np.inf, 0
    while iteration < MOST_ITERATIONS:
        iteration += 1
        K, M = unknowns.assembly.matrices(theta)
        T, d = _equations(given, unknowns, theta, K, M, inverse)
        step = np.linalg.lstsq(T, d, rcond=None)[0]
        change = float(np.abs(step).max())
        best, since = (change, 0) if change < best / 2 else (best, since + 1)
        theta = _moved(unknowns, theta, step, ahead)
        if change < _STILL or (change < SETTLED and since > _PATIENCE) or not np.isfinite(change):
            break
    K, M = unknowns.assembly.matrices(theta)
    z = (theta - unknowns.theta)[unknowns.free] / unknowns.units
    whole = LinearProblem(T, d + T @ z, np.ones(len(d)), np.ones(len(z)))
    bounds = conditioning(whole, z, weighted=False, with_prior=False)
    return Fitted(theta, K, M, iteration, change, change < SETTLED, bounds)


def _moved(unknowns: Unknowns, theta: np.ndarray, step: np.ndarray, ahead: Accelerated) -> np.ndarray:
    """theta after the step, further where earlier steps show the way, or after as much of it as is admissible."""
    z = theta[unknowns.free] / unknowns.units
    proposed = ahead.propose(z, z + step) - z
    for taken in (proposed, *(0.5**power * step for power in range(_HALVINGS))):
        moved = theta.copy()
        moved[unknowns.free] += taken * unknowns.units
        if np.isfinite(moved).all() and unknowns.admissible(moved):
            return moved
        ahead.forget()
    return theta


def _equations(
    given: Given,
    unknowns: Unknowns,
    theta: np.ndarray,
    K: Matrix,
    M: Matrix,
    inverse: Callable[[np.ndarray], np.ndarray],
) -> tuple[np.ndarray, np.ndarray]:
    """T (k + 1, k) and d (k + 1,): |T z - d| is the error for a step of z units. Raises Undetermined.

    A square root of the normal equations of all modes; the last row holds what no step changes.
    """
    slopes, k = unknowns.assembly.slopes(theta), len(unknowns.free)
    X, gram = given.orthonormal(given.expanded(K)), np.zeros((k + 1, k + 1))
    for eigenvalue, x in zip(given.eigenvalues, X.T, strict=True):
        inertia = eigenvalue * (M @ x)
        J = _forces(slopes["K"], x, unknowns)
        if len(slopes["M"]):
            J -= eigenvalue * _forces(slopes["M"], x, unknowns)
        columns = np.column_stack([J * unknowns.units, inertia - K @ x])
        solved = inverse(np.column_stack([columns, inertia]))
        gram += columns.T @ solved[:, :-1] / (inertia @ solved[:, -1])
    values, V = np.linalg.eigh(gram[:k, :k])
    held = values > _RANK * max(values[-1], 1e-300)
    if not held.all():
        loose = np.abs(V[:, ~held]).max(axis=1)
        raise Undetermined(int(held.sum()), loose > 1e-3 * loose.max())
    root = np.sqrt(values)
    d = (V.T @ gram[:k, k]) / root
    rest = np.sqrt(max(gram[k, k] - d @ d, 0.0))
    return np.vstack([root[:, None] * V.T, np.zeros(k)]), np.append(d, rest)


def _forces(slopes: Slopes, x: np.ndarray, unknowns: Unknowns) -> np.ndarray:
    """d(matrix)/d(unknown) x (n, k)."""
    place = np.full(unknowns.assembly.p, -1)
    place[unknowns.free] = np.arange(len(unknowns.free))
    at = place[slopes.parameter]
    own, k = at >= 0, len(unknowns.free)
    flat = slopes.row[own].astype(np.int64) * k + at[own]
    return np.bincount(flat, slopes.value[own] * x[slopes.col[own]], minlength=len(x) * k).reshape(len(x), k)
