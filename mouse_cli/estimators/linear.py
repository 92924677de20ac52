"""The linear problem that every estimator solves, whitened and in square-root form.

Data d = T x + e with e ~ N(0, R); x = L z with z ~ N(0, I) before the test, so S = L L'. The columns of L (p, k) span
what may vary: a property held fixed, or a total mass held fixed, is a direction that L lacks. With B = R^-1/2 T L and
r = R^-1/2 d everything below is small, dimensionless and well scaled; neither R nor S is ever inverted.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np


class Unobservable(ArithmeticError):
    """The data do not determine every property; `loose` (p,) marks those that take part in what is undetermined."""

    def __init__(self, message: str, loose: np.ndarray):
        super().__init__(message)
        self.loose = loose


class Infeasible(ArithmeticError):
    """No values lie within all the limits."""


@dataclass(frozen=True)
class LinearProblem:
    """d = T x + e: T (q, p), d (q,), noise R as standard deviations (q,) or covariance (q, q), root L of the prior.

    L is (p, k), or (p,) when the prior is diagonal. lower, upper (p,): limits on x, or None.
    """

    T: np.ndarray
    d: np.ndarray
    noise: np.ndarray
    L: np.ndarray
    lower: np.ndarray | None = None
    upper: np.ndarray | None = None

    def whiten(self, values: np.ndarray) -> np.ndarray:
        """R^-1/2 times `values` (q,) or (q, k); with correlated noise by the Cholesky factor of R."""
        if self.noise.ndim == 1:
            return (values.T / self.noise).T
        return np.linalg.solve(np.linalg.cholesky(self.noise), values)

    def whitened(self) -> tuple[np.ndarray, np.ndarray]:
        """B = R^-1/2 T L (q, k) and r = R^-1/2 d (q,)."""
        B = self.in_prior_units()
        if self.noise.ndim == 1:
            B /= self.noise[:, None]  # in its own memory: B is the largest array there is
        else:
            B = self.whiten(B)
        return B, self.whiten(self.d)

    def carried(self, rows: np.ndarray) -> np.ndarray:
        """`rows` (k, q) times R^1/2, so that carried carried' = rows R rows'."""
        return rows * self.noise if self.noise.ndim == 1 else rows @ np.linalg.cholesky(self.noise)

    def in_prior_units(self) -> np.ndarray:
        """T L (q, k)."""
        return in_prior_units(self.T, self.L)

    def expand(self, z: np.ndarray) -> np.ndarray:
        """x = L z, for z (k,) or (k, c)."""
        return expand(self.L, z)


def in_prior_units(T: np.ndarray, L: np.ndarray) -> np.ndarray:
    """T L (q, k), for L (p, k) or its diagonal (p,): derivatives by what the prior leaves uncertain, in its units."""
    return T * L if L.ndim == 1 else T @ L


def expand(L: np.ndarray, z: np.ndarray) -> np.ndarray:
    """x = L z, for L (p, k) or its diagonal (p,), and z (k,) or (k, c)."""
    return (L * z.T).T if L.ndim == 1 else L @ z


@dataclass(frozen=True)
class LinearEstimate:
    """x (p,); z (k,) with x = L z; root(): matrix (p, ...) with covariance = root root'.

    seen(): columns of the root that the data see, where T times the others is zero.

    Covariance and variances are computed when asked for: most cycles of a run need neither. variances() is given where there is
    a cheaper way to them than the rows of the root.
    """

    x: np.ndarray
    z: np.ndarray
    root: Callable[[], np.ndarray]
    variances: Callable[[], np.ndarray] | None = None
    seen: Callable[[], np.ndarray] | None = None

    def predicted_variance(self, T: np.ndarray) -> np.ndarray:
        """Diagonal (q,) of T S* T', for the T (q, p) of the problem that was solved."""
        U = T @ (self.seen or self.root)()
        return np.sum(U * U, axis=1)

    @cached_property
    def variance(self) -> np.ndarray:
        """Diagonal (p,) of S*."""
        if self.variances is not None:
            return self.variances()
        U = self.root()
        return np.sum(U * U, axis=1)

    def covariance(self) -> np.ndarray:
        """S* (p, p)."""
        U = self.root()
        return U @ U.T


@dataclass(frozen=True)
class Estimator:
    """A row of Table 3-1. `weighted`: data weighed by R; `uses_prior`: x_p and S take part; `solve` gives the estimate."""

    key: str
    title: str
    equation: str
    weighted: bool
    uses_prior: bool
    solve: Callable[[LinearProblem], LinearEstimate]


def determined(B: np.ndarray, problem: LinearProblem) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Singular value decomposition U s V' of B (q, k) with unit columns, and those column lengths (k,).

    Raises Unobservable when B has not full column rank, naming the properties that take part in its null space.
    """
    q, k = B.shape
    length = np.linalg.norm(B, axis=0)
    scale = np.where(length > 0, length, 1.0)
    U, s, Vt = np.linalg.svd(B / scale, full_matrices=False)
    tolerance = max(q, k) * np.finfo(float).eps * 10 * (s[0] if len(s) else 0.0)
    rank = int(np.count_nonzero(s > tolerance))
    if rank < k:
        null = np.eye(k) - Vt[:rank].T @ Vt[:rank]
        loose = np.abs(problem.expand(null / scale[:, None])) @ np.ones(k)
        loose = loose > 1e-6 * loose.max(initial=0.0)
        raise Unobservable(
            f"of {k} free directions of the properties only {rank} can be determined from the data ({q})", loose
        )
    return U, s, Vt, scale


def without_prior(problem: LinearProblem, weighted: bool) -> LinearEstimate:
    """Least squares over T x = d, weighed by R or not: the rows of Table 3-1 that know no prior.

    W = (T'PT)^-1 T'P and covariance W R W', with P = R^-1 (`weighted`) or P = I. By singular values, T'PT is not formed.
    Raises Unobservable.
    """
    B, r = problem.whitened() if weighted else (problem.in_prior_units(), problem.d)
    U, s, Vt, scale = determined(B, problem)
    inverse = (Vt.T / s) / scale[:, None]  # R^-1 B = V s^-1 U': inverse @ U' is the pseudo-inverse
    z = inverse @ (U.T @ r)
    root_z = inverse if weighted else inverse @ problem.carried(U.T)
    if problem.lower is not None:
        z, active = limited(problem, z, (Vt * s[:, None]) * scale)
        root_z = conditioned(problem, root_z, active)
    return LinearEstimate(problem.expand(z), z, lambda: problem.expand(root_z))


def limited(problem: LinearProblem, z: np.ndarray, C: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The z nearest to the free solution `z` in the metric C'C whose x = L z lies within the limits; and the active ones.

    Least distance programming by non-negative least squares (Lawson and Hanson 1974, ch. 23): exact, and it says so when
    the limits cannot be met. active (p,): -1 at the lower limit, +1 at the upper one, 0 free.
    """
    from scipy.optimize import nnls

    L = np.diag(problem.L) if problem.L.ndim == 1 else problem.L
    G = np.concatenate([L, -L])
    h = np.concatenate([problem.lower, -problem.upper]) - G @ z
    moving = np.linalg.norm(G, axis=1) > 0
    G = G @ np.linalg.inv(C)
    size = np.where(moving, np.linalg.norm(G, axis=1), 1.0)
    with np.errstate(over="ignore"):
        h = h / size
    used = moving & np.isfinite(h)  # a limit farther than any number is none
    G, h = G[used] / size[used, None], h[used]
    active = np.zeros(len(L), int)
    if not (h > 0).any():
        return z, active
    unit = np.abs(h).max()
    E = np.vstack([G.T, h / unit])
    f = np.append(np.zeros(G.shape[1]), 1.0)
    multipliers, _ = nnls(E, f)
    rest = E @ multipliers - f
    if abs(rest[-1]) < 1e-12:
        raise Infeasible("the limits contradict one another: no values lie within all of them")
    step = np.linalg.solve(C, -rest[:-1] / rest[-1] * unit)
    which = np.flatnonzero(used)[multipliers > 0]
    active[which % len(L)] = np.where(which < len(L), -1, 1)
    return z + step, active


def conditioned(problem: LinearProblem, root_z: np.ndarray, active: np.ndarray) -> np.ndarray:
    """`root_z` (k, c) given that the properties `active` (p,), which are not 0 there, stay at their limits."""
    if not active.any():
        return root_z
    rows = problem.expand(root_z)[active != 0]
    basis, s, _ = np.linalg.svd(rows.T, full_matrices=False)
    basis = basis[:, s > 1e-12 * s.max(initial=0.0)]
    return root_z - (root_z @ basis) @ basis.T
