"""Natural frequencies and mode shapes: K x = lambda M x, x'Mx = 1."""

from dataclasses import dataclass

import numpy as np

from mouse_cli.dynamics.frequency import frequency_hz
from mouse_cli.dynamics.krylov import Krylov

RIGID = 1e-6  # |lambda| up to this share of the first measured eigenvalue is a rigid-body mode
_ROUNDED = 1e-13  # shares of the largest eigenvalue: no more than rounding
_LOW = 1e-6  # that share, of a mode that has lost digits to rounding
_PIVOT = 4 * np.finfo(float).eps  # by the order of M, share of masses up to which a pivot is rounding: the motion has none
_MASSLESS = 1e-13  # eigenvalues of M up to this share of the largest are no mass


class IndefiniteError(ArithmeticError):
    """A mass matrix that is not positive semidefinite, or a stiffness matrix with negative eigenvalues."""


@dataclass(frozen=True)
class EigenSolution:
    """eigenvalues (k,) ascending, (rad/s)^2; shapes (n, k), mass-normalised. k = n for a dense model, else the lowest k.

    zero: eigenvalues this near to zero differ from it, and from one another, by rounding alone. space: of a sparse model, the
    Krylov space of (K - shift M)^-1 M that they were found in. verified: so many of them are known to be the lowest, as the
    inertia of K - s M counts them (0: not counted).
    """

    eigenvalues: np.ndarray
    shapes: np.ndarray
    zero: float = 0.0
    space: Krylov | None = None
    shift: float = 0.0
    verified: int = 0

    @property
    def complete(self) -> bool:
        """Whether every mode of the model is here."""
        return self.shapes.shape[0] == self.shapes.shape[1]

    @property
    def frequencies_hz(self) -> np.ndarray:
        """Natural frequencies (k,) in Hz; 0 for eigenvalues that are negative by rounding."""
        return frequency_hz(self.eigenvalues)

    def rigid(self, reference: float) -> int:
        """Number of rigid-body modes: eigenvalues within RIGID of zero, measured by a `reference` eigenvalue."""
        return int(np.count_nonzero(np.abs(self.eigenvalues) <= RIGID * reference))


def dense_solution(K: np.ndarray, M: np.ndarray) -> EigenSolution:
    """All modes of finite frequency; low ones of a slender structure to more digits than the others leave them."""
    return _sharpened(K, M, _by_masses(K, M))


def _by_masses(K: np.ndarray, M: np.ndarray) -> EigenSolution:
    """All modes of finite frequency: the standard problem of L^-1 K L^-T, with M = L L'."""
    masses = M.diagonal()
    if np.count_nonzero(M) == np.count_nonzero(masses):
        if masses.min() < 0:
            raise IndefiniteError(f"mass of degree of freedom {int(np.argmin(masses)) + 1} is {masses.min():.6g}")
        if (masses > 0).all():
            scale = 1.0 / np.sqrt(masses)
            with np.errstate(over="ignore"):
                reduced = K * scale[:, None] * scale
            if not np.isfinite(reduced).all():
                raise np.linalg.LinAlgError(
                    f"beside the stiffnesses a mass of {masses.min():.3g} is too small for a number"
                )
            eigenvalues, vectors = np.linalg.eigh(reduced)
            return EigenSolution(eigenvalues, vectors * scale[:, None])
        return _condensed(K, M)
    try:
        L = None if _singular(M) else np.linalg.cholesky(M)
    except np.linalg.LinAlgError:
        L = None
    if L is None:
        return _condensed(K, M)
    reduced = np.linalg.solve(L, np.linalg.solve(L, K).T)
    eigenvalues, vectors = np.linalg.eigh((reduced + reduced.T) / 2)
    return EigenSolution(eigenvalues, np.linalg.solve(L.T, vectors))


def _singular(M: np.ndarray) -> bool:
    """Whether a pivot of M, the largest first, is rounding beside the masses that it is coupled with.

    Squares of arms that are subtracted leave the rounding of the larger ones, which other orders of pivots would magnify.
    """
    from scipy.linalg.lapack import dpstrf

    L, order, rank, _ = dpstrf(M, tol=np.finfo(float).tiny, lower=1)
    coupled = np.where(M != 0, M.diagonal(), 0.0).max(axis=1)[order - 1]
    return rank < len(M) or bool((L.diagonal() ** 2 <= _PIVOT * len(M) * coupled).any())


def _sharpened(K: np.ndarray, M: np.ndarray, solution: EigenSolution) -> EigenSolution:
    """The solution with its low modes found anew in W = A^-1 M X, A = K - sigma M positive definite, from W'M W and W'A W = W'M X.

    All modes at once carry errors of eps times the largest eigenvalue; these, solved for with residuals in extended precision,
    carry errors of their own size.
    """
    eigenvalues, X = solution.eigenvalues, solution.shapes
    largest = np.abs(eigenvalues).max(initial=0.0)
    elastic = eigenvalues[eigenvalues > _ROUNDED * largest]
    if not len(elastic) or eigenvalues[0] < -_ROUNDED * largest or elastic[0] > _LOW * largest:
        return solution
    low = np.flatnonzero(eigenvalues < _LOW * largest)
    sigma, MX = -0.3 * elastic[0], M @ X[:, low]
    A, extended = K - sigma * M, K.astype(np.longdouble) - np.longdouble(sigma) * M
    W = np.linalg.solve(A, MX)
    W = W + np.linalg.solve(A, (MX - extended @ W).astype(float))
    try:
        L = np.linalg.cholesky(W.T @ MX)
    except np.linalg.LinAlgError:
        return solution
    theta, S = np.linalg.eigh(np.linalg.solve(L, np.linalg.solve(L, W.T @ (M @ W)).T))
    theta, S = theta[::-1], S[:, ::-1]
    eigenvalues, X = eigenvalues.copy(), X.copy()
    eigenvalues[low], X[:, low] = sigma + 1 / theta, W @ np.linalg.solve(L.T, S) / np.sqrt(theta)
    return EigenSolution(eigenvalues, X)


def _condensed(K: np.ndarray, M: np.ndarray) -> EigenSolution:
    """The modes of finite frequency of singular M = Q m Q': motions without mass follow the others statically (Guyan 1965)."""
    m, Q = np.linalg.eigh(M)
    if m[0] < -_MASSLESS * m[-1] or m[-1] <= 0:
        raise IndefiniteError("the mass matrix is not positive semidefinite")
    free, moving = Q[:, m <= _MASSLESS * m[-1]], Q[:, m > _MASSLESS * m[-1]]
    stiff = free.T @ K @ free
    try:
        np.linalg.cholesky(stiff)
    except np.linalg.LinAlgError:
        raise IndefiniteError("motions that have no mass have no stiffness either") from None
    follow = moving - free @ np.linalg.solve(stiff, free.T @ (K @ moving))
    follow /= np.sqrt(m[m > _MASSLESS * m[-1]])
    reduced = follow.T @ K @ follow
    eigenvalues, vectors = np.linalg.eigh((reduced + reduced.T) / 2)
    return EigenSolution(eigenvalues, follow @ vectors)


def clusters(eigenvalues: np.ndarray, zero: float = 0.0) -> np.ndarray:
    """Cluster number (k,) of each ascending eigenvalue: neighbours closer than 1e-6, relative, or than `zero` share one.

    Within a cluster single vectors are not defined, only their span; derivatives are taken for the span.
    """
    gap = np.diff(eigenvalues)
    size = np.maximum(np.abs(eigenvalues[1:]), np.abs(eigenvalues[:-1]))
    floor = np.finfo(float).eps * np.abs(eigenvalues).max(initial=0.0) * len(eigenvalues)
    return np.concatenate([[0], np.cumsum(gap > 1e-6 * size + floor + zero)]).astype(int)
