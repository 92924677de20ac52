"""Resolvent matching: whether a force through one place, of whatever law, can make the shapes that were measured.

A model that lacks a force through the channel B has the modes phi_i = R(lambda_i) B g_i exactly, R = (K - lambda M)^-1 and
lambda_i the measured eigenvalue: so y_i is compared with a_i h_i, h_i = S R(lambda_i) B, for any a_i. What the test leaves open of
lambda_i is averaged over nodes, as h_i may turn within one standard deviation; what the deck leaves open of its parameters z,
N(0, 1), is marginalised by Laplace: with r the misfit, J its derivatives, projected so that a_i follows (Kaufman 1975),

    cost(z) = -2 sum over modes of ln mean over nodes of exp(-|r|^2 / 2) + |z|^2,     -2 ln p = min cost + ln |I + J'J|
"""

from dataclasses import dataclass

import numpy as np

from mouse_cli.diagnosis.reduced import Reduced
from mouse_cli.dynamics.frequency import eigenvalue

_POLE = 1e-7  # distance of lambda from an eigenvalue of the model, relative, below which R is taken beside it
_NODES = np.linspace(-2.0, 2.0, 7)  # of lambda, in standard deviations
_LOG_WEIGHTS = -0.5 * _NODES**2 - np.log(np.sum(np.exp(-0.5 * _NODES**2)))
_CHUNK = 20_000_000  # numbers of derivatives held at once


@dataclass(frozen=True)
class Matches:
    """For j places at their z (j, k): cost (j,); N (j, k, k) = I + J'J and b (j, k) = J'r - z, whence the next z."""

    z: np.ndarray
    cost: np.ndarray
    N: np.ndarray
    b: np.ndarray

    def step(self, damping: np.ndarray) -> np.ndarray:
        """Change of z (j, k) that lowers the cost, after Levenberg and Marquardt with damping (j,)."""
        diagonal = np.einsum("jkk->jk", self.N)
        return np.linalg.solve(
            self.N + (damping[:, None] * diagonal)[:, :, None] * np.eye(self.z.shape[1]), self.b[:, :, None]
        )[:, :, 0]

    def gain(self) -> np.ndarray:
        """What a full step would lower the cost by (j,), were it quadratic."""
        return np.einsum("jk,jk->j", self.b, self.step(np.zeros(len(self.cost))))

    def volume(self) -> np.ndarray:
        """ln |I + J'J| (j,)."""
        return np.linalg.slogdet(self.N)[1]


@dataclass(frozen=True)
class Shapes:
    """Measured modes (m,) that tell a place: at least two components of shape, and a frequency. dof: components less scales."""

    modes: np.ndarray
    eigenvalue: np.ndarray
    sd: np.ndarray
    y: np.ndarray
    weight: np.ndarray
    dof: int


def shapes(model: Reduced) -> Shapes:
    """What the test says of shapes: y, weight (s, m) over their standard deviations, 0 where nothing was measured."""
    test = model.data.test
    has = np.isfinite(test.shapes)
    modes = np.flatnonzero(np.isfinite(test.frequency_hz) & (has.sum(axis=0) >= 2))
    has, hz = has[:, modes], test.frequency_hz[modes]
    weight = np.where(has, 1 / np.where(has, test.shape_sd[:, modes], 1.0), 0.0)
    y = np.where(has, test.shapes[:, modes], 0.0) * weight
    at = eigenvalue(hz)
    return Shapes(modes, at, 2 * test.frequency_sd_hz[modes] / hz * at, y, weight, int(has.sum()) - len(modes))


class Matcher:
    """The model at z (k,), in its own modes: X (r, r), eigenvalues (r,), what sensors see (s, r), dK and dM by z (k, r, r)."""

    def __init__(self, model: Reduced, measured: Shapes, z: np.ndarray):
        self.measured, self.z = measured, z
        K, M = model.matrices(z)
        C = np.linalg.inv(np.linalg.cholesky(M))
        self.eigenvalues, Q = np.linalg.eigh(C @ K @ C.T)
        self.X = C.T @ Q
        self.seen = model.sensing @ self.X
        dK, dM = model.slopes(z)
        self.dK, self.dM = (self.X.T @ d @ self.X for d in (dK, dM))

    def match(self, rows: np.ndarray) -> Matches:
        """All places B (j, r)."""
        k, s = len(self.z), len(self.measured.y)
        each = max(1, _CHUNK // max(1, k * s))
        parts = [self._match(rows[i : i + each] @ self.X) for i in range(0, len(rows), each)]
        return Matches(*(np.concatenate([getattr(part, name) for part in parts]) for name in Matches.__annotations__))

    def _match(self, B: np.ndarray) -> Matches:
        j, k = len(B), len(self.z)
        N, b = np.zeros((j, k, k)) + np.eye(k), np.zeros((j, k)) - self.z
        cost = np.full(j, self.z @ self.z)
        for i in range(len(self.measured.modes)):
            misfit = np.stack([self._misfit(i, node, B)[2] for node in range(len(_NODES))])
            cost += -2 * np.logaddexp.reduce(-0.5 * misfit + _LOG_WEIGHTS[:, None], axis=0)
            best = np.argmin(misfit - 2 * _LOG_WEIGHTS[:, None], axis=0)
            for node in np.unique(best):
                own = np.flatnonzero(best == node)
                r, J = self._derivatives(i, node, B[own])
                N[own] += np.swapaxes(J, 1, 2) @ J
                b[own] += np.einsum("jsk,js->jk", J, r)
        return Matches(np.zeros((j, k)) + self.z, cost, N, b)

    def _resolvent(self, i: int, node: int) -> tuple[float, np.ndarray]:
        """lambda_i at a node, and 1 / (eigenvalues - lambda_i) (r,)."""
        at = self.measured.eigenvalue[i] + _NODES[node] * self.measured.sd[i]
        apart = self.eigenvalues - at
        near = np.abs(apart) < _POLE * at
        return at, 1 / np.where(near, np.where(apart < 0, -1, 1) * _POLE * at, apart)

    def _misfit(self, i: int, node: int, B: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """h (j, s) of mode i, its scales a (j,), and |y - a h|^2 (j,)."""
        y = self.measured.y[:, i]
        h = B @ (self.seen * self._resolvent(i, node)[1] * self.measured.weight[:, i, None]).T
        along, size = h @ y, np.maximum(np.einsum("js,js->j", h, h), 1e-300)
        return h, along / size, y @ y - along**2 / size

    def _derivatives(self, i: int, node: int, B: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Misfit r (j, s) of mode i, and derivatives J (j, s, k) of what it is compared with."""
        at, D = self._resolvent(i, node)
        h, a, _ = self._misfit(i, node, B)
        unit = h / np.sqrt(np.maximum(np.einsum("js,js->j", h, h), 1e-300))[:, None]
        G = (self.seen * D * self.measured.weight[:, i, None]) @ (self.dK - at * self.dM)
        J = -np.einsum("jr,ksr->jsk", (a[:, None] * B) * D, G, optimize=True)
        J -= unit[:, :, None] * np.einsum("js,jsk->jk", unit, J)[:, None, :]
        return self.measured.y[:, i] - a[:, None] * h, J
