"""Shapes that leave the smallest force residual (K - lambda M) u: support of the methods that choose its norm."""

import numpy as np

from mouse_cli.dynamics.condensation import LooseError, bordered, weights
from mouse_cli.dynamics.expansion import Measured
from mouse_cli.model.arrays import Matrix, is_sparse


def least_residual(measured: Measured, norm: str) -> np.ndarray:
    """Shapes (n, m) that minimise |Z u|^2, Z = K - lambda_i M, through the measured components or near to them.

    norm `euclidean`: r'r; `energy`: r'K^-1 r. Smoothed components v minimise |Z u|^2 with the sum of ((v - t) / sd)^2 equal to
    their number, what their errors let expect (Morozov 1966).
    """
    K, M, n = measured.K, measured.M, measured.K.shape[0]
    columns = []
    for eigenvalue, (sensing, t, sd) in zip(measured.eigenvalues, measured.modes(), strict=True):
        given = t[:, None] if measured.exact else np.eye(len(t))
        shapes, Q = _least(K, M, eigenvalue, weights(sensing, n), given, norm)
        columns.append(shapes[:, 0] if measured.exact else shapes @ smoothed(Q, t, sd))
    return np.column_stack(columns)


def _least(
    K: Matrix, M: Matrix, eigenvalue: float, S: Matrix, given: np.ndarray, norm: str
) -> tuple[np.ndarray, np.ndarray]:
    """Shapes (n, k) for `given` readings (s, k), and the forces (s, k) at the sensors: for unit readings |Z u|^2 = v'Q v.

    With Z u = N p stationarity is Z p + S'f = 0, one regular system in p, u and f; nothing is squared.
    """
    Z, n, s = K - eigenvalue * M, K.shape[0], S.shape[0]
    scale = float(np.abs(K.diagonal()).max())
    if norm == "euclidean":  # near the least singular value of Z the system is conditioned like Z and no worse
        scale = abs(eigenvalue) * float(np.median(M.diagonal()))
    if is_sparse(Z):
        from scipy.sparse import block_array, csr_array, eye_array

        N = eye_array(n) if norm == "euclidean" else K / scale
        A = block_array([[-N, Z / scale], [Z / scale, None]], format="csc")
        B = csr_array((S.data, S.indices + n, S.indptr), shape=(s, 2 * n))
    else:
        N = np.eye(n) if norm == "euclidean" else K / scale
        A = np.block([[-N, Z / scale], [Z / scale, np.zeros((n, n))]])
        B = np.hstack([np.zeros((s, n)), S.toarray()])
    right = np.zeros((2 * n + s, given.shape[1]))
    right[2 * n :] = given
    solution = bordered(A, B, None, right)
    shapes = solution[n : 2 * n]
    if not np.isfinite(solution).all() or np.abs(S @ shapes - given).max() > 1e-5 * np.abs(given).max():
        raise LooseError("the sensors leave a motion of the structure undetermined")
    return shapes, -solution[2 * n :]


def smoothed(Q: np.ndarray, t: np.ndarray, sd: np.ndarray) -> np.ndarray:
    """v (s,) that minimises v'Q v while the sum of ((v - t) / sd)^2 is s, or comes nearest to that; t where it is all noise."""
    if np.sum((t / sd) ** 2) <= len(t):
        return t
    from scipy.optimize import brentq

    values, vectors = np.linalg.eigh(sd[:, None] * (Q + Q.T) / 2 * sd)
    values, part = np.maximum(values, 0.0), vectors.T @ (t / sd)
    largest = max(float(values[-1]), np.finfo(float).tiny)
    left = lambda power: float(np.sum((values / (values + largest * 10.0**power) * part) ** 2)) - len(t)
    low, high = -20.0, 20.0
    power = low if left(low) <= 0 else brentq(left, low, high)
    trust = largest * 10.0**power
    return sd * (vectors @ (trust / (values + trust) * part))
