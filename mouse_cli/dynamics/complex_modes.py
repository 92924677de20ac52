"""Complex modes: (s^2 M + s C + K + iD) psi = 0, poles s with Im s > 0.

Without C they follow from (K + iD) psi = lambda M psi and s = i sqrt(lambda); with C from the first-order form of twice the size.
A large model is solved in the basis of its FRFs, whose error is found for every pole by its residual. Damping ratio -Re s / |s|,
half the loss factor at resonance; complexity 1 - |psi'M psi|^2 / (psi^H M psi)^2, 0 for a real shape (Imregun and Ewins 1995).
"""

from dataclasses import dataclass

import numpy as np

from mouse_cli.dynamics.eigen import EigenSolution
from mouse_cli.dynamics.frf import Dynamics
from mouse_cli.dynamics.frf_basis import galerkin
from mouse_cli.dynamics.frf_slopes import Change

_STILL = 1e-9  # of the largest |s|: a rigid-body motion, or one that does not oscillate


@dataclass(frozen=True)
class ComplexModes:
    """poles (k,), rad/s, by |s|; shapes (n, k), psi'(M + C / 2s) psi = 1; complexity (k,); error (k,): estimated, of s."""

    poles: np.ndarray
    shapes: np.ndarray
    complexity: np.ndarray
    error: np.ndarray

    @property
    def frequencies_hz(self) -> np.ndarray:
        """|s| / 2 pi (k,)."""
        return np.abs(self.poles) / (2 * np.pi)

    @property
    def damping(self) -> np.ndarray:
        """Damping ratios (k,)."""
        return -self.poles.real / np.abs(self.poles)

    def damping_slopes(self, dynamics: Dynamics, change: Change) -> np.ndarray:
        """d(damping ratio)/dp (k, p), by ds/dp = -psi'(dZ/dp) psi / psi'(2s M + C) psi (Adhikari 1999); the denominator is 2s."""
        k, s = len(self.poles), self.poles
        projected = change.projected(np.concatenate([self.shapes.real, self.shapes.imag], axis=1).T)
        own, dZ = np.arange(k), 0.0
        for name, weight in (("K", 1.0), ("M", s**2), ("C", s), ("D", 1j)):
            if name in projected:
                B = projected[name]
                real, imag, mixed = B[:, own, own], B[:, own + k, own + k], B[:, own, own + k] + B[:, own + k, own]
                dZ = dZ + weight * (real - imag + 1j * mixed)
        ds = np.broadcast_to(-dZ / (2 * s), (change.p, k)).T
        size = np.abs(s)[:, None]
        return -ds.real / size + s.real[:, None] * (s.conj()[:, None] * ds).real / size**3


def complex_modes(dynamics: Dynamics, solution: EigenSolution, count: int) -> ComplexModes:
    """The `count` poles of the lowest |s|, those that oscillate.

    solution: of K and M, with at least as many modes, and its space alive for a sparse model.
    """
    V, reduced, residual = galerkin(dynamics, solution)
    poles, X = _solved(reduced)
    order = np.argsort(np.abs(poles), kind="stable")[:count]
    poles, X = poles[order], X[:, order]
    kept = poles.imag > _STILL * np.abs(poles).max(initial=0.0)
    poles, X = poles[kept], X[:, kept]
    M = reduced.M if reduced.C is None else None
    scale = np.einsum("dk,dk->k", X, reduced.M @ X)
    if M is None:
        scale = scale + np.einsum("dk,dk->k", X, reduced.C @ X) / (2 * poles)
    X = X / np.sqrt(scale)
    inner, size = np.einsum("dk,dk->k", X, reduced.M @ X), np.einsum("dk,dk->k", X.conj(), reduced.M @ X).real
    shapes = X if V is None else V.T @ X
    return ComplexModes(poles, shapes, 1 - np.abs(inner) ** 2 / size**2, residual(poles, shapes))


def _solved(m: Dynamics) -> tuple[np.ndarray, np.ndarray]:
    """Poles (d',) with Im s >= 0 and shapes (d, d') of dense matrices with M positive definite."""
    lower = np.linalg.cholesky(m.M)
    inverse = np.linalg.inv(lower)
    stiff = inverse @ (m.K if m.D is None else m.K + 1j * m.D) @ inverse.T
    if m.C is None:
        lam, X = np.linalg.eig(stiff)
        poles = 1j * np.sqrt(lam.astype(complex))
        return np.where(poles.imag < 0, -poles, poles), inverse.T @ X
    viscous, d = inverse @ m.C @ inverse.T, len(m.M)
    scale = np.sqrt(np.linalg.norm(stiff, 2))
    first = np.block([[np.zeros((d, d)), scale * np.eye(d)], [-stiff / scale, -viscous]])
    poles, X = np.linalg.eig(first)
    upper = poles.imag > 0
    return poles[upper], inverse.T @ X[:d, upper]
