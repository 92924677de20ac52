"""Resolvent matching: whether a force through one place, of whatever law, can make the shapes that were measured.

A model that lacks a force through the channel B has the modes phi_i = R(lambda_i) B g_i exactly, R = (K - lambda M)^-1 and
lambda_i the measured eigenvalue: so y_i is compared with a_i h_i, h_i = S R(lambda_i) B, for any a_i. What the parameters z of the
deck leave uncertain, N(0, 1), and the errors of lambda_i are marginalised: with r the misfit at a point z_0, J its derivatives by
both, projected so that a_i follows (Kaufman 1975),

    -2 ln p = min over dz of |r - J dz|^2 + |z_0 + dz|^2 + ln |I + J'J|

The direction of h_i is almost linear in lambda_i and z although h_i has poles, so few points z_0 are enough.
"""

from dataclasses import dataclass

import numpy as np

from mouse_cli.diagnosis.reduced import Reduced
from mouse_cli.dynamics.frequency import eigenvalue

_POLE = 1e-7  # distance of lambda from an eigenvalue of the model, relative, below which R is taken beside it
_CHUNK = 20_000_000  # numbers of derivatives held at once


@dataclass(frozen=True)
class Matches:
    """For j places: cost (j,) = -2 ln p; chi2 (j,) its part that is misfit and shift; z (j, k) of least cost; step (j,) = |dz|."""

    cost: np.ndarray
    chi2: np.ndarray
    z: np.ndarray
    step: np.ndarray


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

    def resolvent(self, i: int) -> np.ndarray:
        """1 / (eigenvalues - lambda_i) (r,)."""
        at = self.measured.eigenvalue[i]
        apart = self.eigenvalues - at
        near = np.abs(apart) < _POLE * at
        return 1 / np.where(near, np.where(apart < 0, -1, 1) * _POLE * at, apart)

    def match(self, rows: np.ndarray) -> Matches:
        """All places B (j, r)."""
        k, s = len(self.z), len(self.measured.y)
        each = max(1, _CHUNK // max(1, k * s))
        parts = [self._match(rows[i : i + each] @ self.X) for i in range(0, len(rows), each)]
        return Matches(*(np.concatenate([getattr(part, name) for part in parts]) for name in Matches.__annotations__))

    def _match(self, B: np.ndarray) -> Matches:
        j, k = len(B), len(self.z)
        N, b = np.zeros((j, k, k)) + np.eye(k), np.zeros((j, k)) - self.z
        least, size = np.full(j, self.z @ self.z), np.zeros(j)
        for i in range(len(self.measured.modes)):
            r, J, e = self._mode(i, B)
            spread = 1 + np.einsum("js,js->j", e, e)
            along = np.einsum("js,js->j", e, r)
            eJ = np.einsum("js,jsk->jk", e, J)
            N += np.swapaxes(J, 1, 2) @ J - eJ[:, :, None] * eJ[:, None, :] / spread[:, None, None]
            b += np.einsum("jsk,js->jk", J, r) - eJ * (along / spread)[:, None]
            least += np.einsum("js,js->j", r, r) - along**2 / spread
            size += np.log(spread)
        dz = np.linalg.solve(N, b[:, :, None])[:, :, 0]
        chi2 = least - np.einsum("jk,jk->j", dz, b)
        return Matches(chi2 + size + np.linalg.slogdet(N)[1], chi2, self.z + dz, np.linalg.norm(dz, axis=1))

    def _mode(self, i: int, B: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Misfit r (j, s) of mode i, and its derivatives by z (j, s, k) and by lambda_i in standard deviations (j, s)."""
        D, w, y = self.resolvent(i), self.measured.weight[:, i], self.measured.y[:, i]
        S = self.seen * D * w[:, None]
        h = B @ S.T
        size = np.maximum(np.einsum("js,js->j", h, h), 1e-300)
        a = h @ y / size
        unit = h / np.sqrt(size)[:, None]
        scaled = (a[:, None] * B) * D
        G = S @ (self.dK - self.measured.eigenvalue[i] * self.dM)
        J = -np.einsum("jr,ksr->jsk", scaled, G, optimize=True)
        J -= unit[:, :, None] * np.einsum("js,jsk->jk", unit, J)[:, None, :]
        e = self.measured.sd[i] * (scaled @ S.T)
        e -= unit * np.einsum("js,js->j", unit, e)[:, None]
        return y - a[:, None] * h, J, e
