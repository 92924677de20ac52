"""Dynamic stiffness that modes take apart: damping that follows K and M leaves them uncoupled, local damping nearly so.

With K X = M X diag(lambda), X'MX = I and C = a K + b M + P diag(c) P', Z is diagonal in X but for P, whose columns are few where
dashpots are; by Sherman, Morrison and Woodbury a line then costs what these columns cost. D likewise.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np

_NOTHING = 1e-11  # of the largest eigenvalue of a damping matrix: rounding
_FEW = 0.2  # share of the modes that local damping may couple for this to pay
_ROOM = 4_000_000  # complex numbers worked on at once


@dataclass(frozen=True)
class Uncoupled:
    """lam (d,); X (d, d); multiples (K, M) of viscous and of structural damping; P (d, r) with weights of both kinds (r,)."""

    lam: np.ndarray
    X: np.ndarray
    viscous: tuple[float, float]
    structural: tuple[float, float]
    P: np.ndarray
    c: np.ndarray
    h: np.ndarray

    def solve(self, s: np.ndarray, loads: np.ndarray) -> np.ndarray:
        """Z(s)^-1 loads (f, d, l) for s (f,)."""
        L, out = self.X.T @ loads, np.empty((len(s), *loads.shape), complex)
        each = max(1, _ROOM // max(loads.size, 1))
        for first in range(0, len(s), each):
            at = slice(first, first + each)
            out[at] = _left(self.X, self._solved(s[at], L))
        return out

    def _solved(self, s: np.ndarray, L: np.ndarray) -> np.ndarray:
        z = s[:, None]
        (c_K, c_M), (d_K, d_M) = self.viscous, self.structural
        z = self.lam + z**2 + z * (c_K * self.lam + c_M) + 1j * (d_K * self.lam + d_M)
        Y = L / z[:, :, None]
        if self.P.shape[1]:
            weights = s[:, None] * self.c + 1j * self.h
            G = self.P / z[:, :, None]
            inner = np.eye(len(self.c)) + weights[:, :, None] * _left(self.P.T, G)
            Y = Y - np.matmul(G, np.linalg.solve(inner, weights[:, :, None] * _left(self.P.T, Y)))
        return Y


def uncoupled(matrices: Any) -> Uncoupled | None:
    """The dynamic stiffness of dense `matrices` (K, M, C, D) by its modes; None where damping couples too many of them."""
    try:
        lower = np.linalg.cholesky(matrices.M)
    except np.linalg.LinAlgError:
        return None
    inverse = np.linalg.inv(lower)
    reduced = inverse @ matrices.K @ inverse.T
    lam, X = np.linalg.eigh((reduced + reduced.T) / 2)
    X = inverse.T @ X
    found = [_parted(damping, X, lam) for damping in (matrices.C, matrices.D)]
    if any(each is None for each in found):
        return None
    (viscous, P, c), (structural, Q, h) = found
    none = np.zeros
    return Uncoupled(
        lam,
        X,
        viscous,
        structural,
        np.hstack([P, Q]),
        np.concatenate([c, none(len(h))]),
        np.concatenate([none(len(c)), h]),
    )


def _parted(
    damping: np.ndarray | None, X: np.ndarray, lam: np.ndarray
) -> tuple[tuple[float, float], np.ndarray, np.ndarray] | None:
    """Multiples of K and M in `damping`, and the rest as P diag(c) P'; None where its rank is large."""
    d = len(lam)
    if damping is None or not damping.any():
        return (0.0, 0.0), np.zeros((d, 0)), np.zeros(0)
    modal = X.T @ damping @ X
    scale = np.sqrt(np.maximum(np.abs(lam), np.abs(lam).max() * np.finfo(float).eps))
    for multiples in ((0.0, 0.0), _multiples(modal, lam)):
        rest = modal - np.diag(multiples[0] * lam + multiples[1])
        w, U = np.linalg.eigh(rest / np.outer(scale, scale))  # as shares of modal stiffness: all modes count
        large = np.linalg.norm(modal / np.outer(scale, scale), 2)
        kept = np.abs(w) > _NOTHING * large
        if kept.sum() <= _FEW * d:
            return multiples, scale[:, None] * U[:, kept], w[kept]
    return None


def _multiples(modal: np.ndarray, lam: np.ndarray) -> tuple[float, float]:
    """a, b of the nearest a diag(lam) + b, by relative deviations."""
    size = np.abs(lam) + np.abs(lam).max() * np.finfo(float).eps
    parts = np.stack([lam, np.ones_like(lam)], axis=1) / size[:, None]
    length = np.linalg.norm(parts, axis=0)
    a, b = (np.linalg.lstsq(parts / length, modal.diagonal() / size, rcond=None)[0] / length).tolist()
    return a, b


def _left(real: np.ndarray, Y: np.ndarray) -> np.ndarray:
    """real (a, d) times Y (f, d, l) complex, in real arithmetic."""
    f, d, l = Y.shape
    flat = np.moveaxis(Y, 1, 0).reshape(d, f * l)
    out = real @ np.concatenate([flat.real, flat.imag], axis=1)
    return np.moveaxis((out[:, : f * l] + 1j * out[:, f * l :]).reshape(-1, f, l), 0, 1)
