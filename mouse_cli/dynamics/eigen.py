"""Natural frequencies and mode shapes: K x = lambda M x, x'Mx = 1."""

from dataclasses import dataclass

import numpy as np

from mouse_cli.dynamics.frequency import frequency_hz
from mouse_cli.model.arrays import Matrix, dense, is_sparse

RIGID = 1e-6  # |lambda| up to this share of the first measured eigenvalue is a rigid-body mode


class IndefiniteError(ArithmeticError):
    """A mass matrix that is not positive definite, or a stiffness matrix with negative eigenvalues."""


@dataclass(frozen=True)
class EigenSolution:
    """eigenvalues (k,) ascending, (rad/s)^2; shapes (n, k), mass-normalised. k = n for a dense model, else the lowest k.

    zero: eigenvalues this near to zero differ from it, and from one another, by rounding alone.
    """

    eigenvalues: np.ndarray
    shapes: np.ndarray
    zero: float = 0.0

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


def eigensolution(K: Matrix, M: Matrix, count: int | None = None, shift: float | None = None) -> EigenSolution:
    """Lowest `count` modes of symmetric K and positive definite M (all of them for dense matrices).

    Dense matrices go to LAPACK through the Cholesky factor of M; sparse ones to shift-invert Lanczos at `shift` < 0,
    so that K - shift M is positive definite although the structure may move as a rigid body.

    Raises IndefiniteError when M is not positive definite, and for sparse matrices when K has eigenvalues below the shift.

    >>> import numpy as np
    >>> eigensolution(np.array([[2.0, -1.0], [-1.0, 2.0]]), np.eye(2)).eigenvalues.round(12).tolist()
    [1.0, 3.0]
    """
    if is_sparse(K) or is_sparse(M):
        return _sparse(K, M, count or min(20, K.shape[0] - 2), shift)
    return _dense(K, M)


def _dense(K: np.ndarray, M: np.ndarray) -> EigenSolution:
    """All modes: the standard problem of L^-1 K L^-T, with M = L L'."""
    masses = M.diagonal()
    if np.count_nonzero(M) == np.count_nonzero(masses):
        if not (masses > 0).all():
            raise IndefiniteError(f"mass of degree of freedom {int(np.argmin(masses)) + 1} is {masses.min():.6g}")
        scale = 1.0 / np.sqrt(masses)
        eigenvalues, vectors = np.linalg.eigh(K * scale[:, None] * scale)
        return EigenSolution(eigenvalues, vectors * scale[:, None])
    try:
        L = np.linalg.cholesky(M)
    except np.linalg.LinAlgError:
        raise IndefiniteError("the mass matrix is not positive definite") from None
    reduced = np.linalg.solve(L, np.linalg.solve(L, K).T)
    eigenvalues, vectors = np.linalg.eigh((reduced + reduced.T) / 2)
    return EigenSolution(eigenvalues, np.linalg.solve(L.T, vectors))


def _sparse(K: Matrix, M: Matrix, count: int, shift: float | None) -> EigenSolution:
    """Lowest modes by ARPACK, with a factorisation whose ordering suits symmetric matrices."""
    from scipy.sparse.linalg import LinearOperator, eigsh

    n = K.shape[0]
    if n < 3 * count + 10:
        return _dense(dense(K), dense(M))
    if M.diagonal().min() < 0:
        raise IndefiniteError("the mass matrix is not positive definite")
    if shift is None:
        shift = -1e-4 * float(np.min(K.diagonal() / M.diagonal()))
    factor = symmetric_factor(K - shift * M)
    if not _positive(factor):  # Lanczos near the shift would not see what lies far below it
        raise IndefiniteError(f"the stiffness matrix has eigenvalues below {shift:.6g} (rad/s)^2")
    inverse = LinearOperator((n, n), matvec=factor.solve, dtype=float)
    start = np.random.default_rng(0).standard_normal(n)  # the same answer at every run
    eigenvalues, vectors = eigsh(K, count, M, sigma=shift, OPinv=inverse, v0=start, tol=1e-11)
    order = np.argsort(eigenvalues)
    vectors = vectors[:, order]
    length = np.sqrt(np.einsum("ij,ij->j", vectors, M @ vectors))
    return EigenSolution(eigenvalues[order], vectors / length, zero=1e-8 * abs(shift))


def symmetric_factor(matrix: Matrix):
    """Sparse LU of a symmetric matrix, ordered by minimum degree of A + A' (the default ordering fills in far more)."""
    from scipy.sparse import csc_array
    from scipy.sparse.linalg import splu

    return splu(csc_array(matrix), permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options={"SymmetricMode": True})


def _positive(factor) -> bool:
    """Whether the factorised symmetric matrix is positive definite: all pivots positive, on the diagonal (Sylvester)."""
    return bool((factor.perm_r == factor.perm_c).all() and (factor.U.diagonal() > 0).all())


def clusters(eigenvalues: np.ndarray, zero: float = 0.0, tolerance: float = 1e-6) -> np.ndarray:
    """Cluster number (k,) of each ascending eigenvalue: neighbours closer than `tolerance`, relative, or `zero` share one.

    Within a cluster single vectors are not defined, only their span; derivatives are taken for the span.
    """
    gap = np.diff(eigenvalues)
    size = np.maximum(np.abs(eigenvalues[1:]), np.abs(eigenvalues[:-1]))
    floor = np.finfo(float).eps * np.abs(eigenvalues).max(initial=0.0) * len(eigenvalues)
    return np.concatenate([[0], np.cumsum(gap > tolerance * size + floor + zero)]).astype(int)
