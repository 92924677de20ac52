"""Shapes that leave the smallest force residual (K - lambda M) u: support of the methods that choose its norm."""

import numpy as np

from mouse_cli.dynamics.condensation import bordered, checked, weights
from mouse_cli.dynamics.expansion import Measured
from mouse_cli.model.arrays import Matrix


def least_residual(measured: Measured, norm: str) -> np.ndarray:
    """Shapes (n, m) that minimise |Z u|^2, Z = K - lambda_i M, through the measured components or near to them.

    norm `euclidean`: r'r; `energy`: r'K^-1 r. Smoothed components v minimise |Z u|^2 with the sum of ((v - t) / sd)^2 equal to
    their number, what their errors let expect (Morozov 1966).
    """
    K, M = measured.K, measured.M
    columns = []
    for eigenvalue, (sensing, t, sd) in zip(measured.eigenvalues, measured.modes(), strict=True):
        given = t[:, None] if measured.exact else np.eye(len(t))
        shapes, Q = _least(K, M, eigenvalue, sensing, given, norm)
        columns.append(shapes[:, 0] if measured.exact else shapes @ smoothed(Q, t, sd))
    return np.column_stack(columns)


def _least(
    K: Matrix, M: Matrix, eigenvalue: float, sensing: Matrix, given: np.ndarray, norm: str
) -> tuple[np.ndarray, np.ndarray]:
    """Shapes (n, k) for `given` readings (s, k), and Q (s, s): the least |Z u|^2 for readings v is v'Q v.

    With Z u = N p stationarity makes p a motion without force but at the sensors, p = D b, where Z D = S'F and S D = 1. Then
    u = D v + B b with Z B = N D - S'(D'N D), S B = 0, and b = (D'N D)^-1 F v: one factorisation, nothing squared.
    """
    n, s = K.shape[0], sensing.shape[0]
    solve = bordered(K - eigenvalue * M, weights(sensing, n))
    D, F = solve(np.zeros((n, s)), np.eye(s))
    checked(D, sensing, np.eye(s))
    ND = D if norm == "euclidean" else K @ D
    B = solve(ND, np.zeros((s, s)))[0]
    b = np.linalg.solve(D.T @ ND, F)
    return D @ given + B @ (b @ given), F.T @ b


def smoothed(Q: np.ndarray, t: np.ndarray, sd: np.ndarray) -> np.ndarray:
    """v (s,) that minimises v'Q v while the sum of ((v - t) / sd)^2 is s, or comes nearest to that; t where it is all noise."""
    from scipy.linalg import norm  # scaled: squares of readings far beyond their sd overflow
    from scipy.optimize import brentq

    noise = float(np.sqrt(len(t)))
    if norm(t / sd) <= noise:
        return t

    values, vectors = np.linalg.eigh(sd[:, None] * (Q + Q.T) / 2 * sd)
    values, part = np.maximum(values, 0.0), vectors.T @ (t / sd)
    largest = max(float(values[-1]), np.finfo(float).tiny)
    left = lambda power: float(norm(values / (values + largest * 10.0**power) * part)) - noise
    low, high = -20.0, max(0.0, float(np.log10(norm(part) / noise))) + 1.0  # left(power) <= 10^-power |part| - noise
    power = low if left(low) <= 0 else brentq(left, low, high)
    trust = largest * 10.0**power
    return sd * (vectors @ (trust / (values + trust) * part))
