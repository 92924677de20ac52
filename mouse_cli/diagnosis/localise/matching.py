"""Resolvent matching: whether a force through one place, of whatever law, can make the shapes that were measured.

A model that lacks a force through the channel B has the modes phi_i = R(lambda_i) B g_i exactly, R = (K - lambda M)^-1 and
lambda_i the measured eigenvalue: so y_i is compared with a_i h_i, h_i = S R(lambda_i) B, for any a_i. What the test leaves open of
lambda_i, t_i standard deviations, and the deck of its parameters z, both N(0, 1), is marginalised by Laplace: with r the misfit, J
its derivatives by z and e_i those by t_i, projected so that a_i follows (Kaufman 1975),

    cost(z) = sum over modes of min over t_i of |r_i|^2 + t_i^2, + |z|^2
    -2 ln p = min cost + ln |I + J'(I + e e')^-1 J| + ln |I + e'e|

h_i may turn within a small part of one standard deviation, where its mode of the model hardly moves at B. Times the distance from
that pole it is almost linear in lambda, u + t v: so the least misfit over t is found in five products of each place.

A place at a node of a mode cannot act on it: that mode stays the model's own, at its eigenvalue, and is compared with that.
"""

from dataclasses import dataclass

import numpy as np

from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.dynamics.frequency import eigenvalue

_POLE = 1e-7  # distance of lambda from an eigenvalue of the model, relative, below which R is taken beside it
_NODE = 0.02  # of the largest motion in the measured modes: what does not move more sits at a node
_STARTS = (-2.0, -1.0, 0.0, 1.0, 2.0)  # of t
_WIDEST, _HALVINGS = 4.0, 22
_VANISHED = 1e-9  # share of |u|^2 + |t v|^2 below which |u + t v|^2 is rounding
_CHUNK = 20_000_000  # numbers of derivatives held at once


@dataclass(frozen=True)
class Matches:
    """For j places at their z (j, k): cost (j,); N (j, k, k) half its curvature, b (j, k) = J'r - z; turns (j,) = ln |I + e'e|."""

    z: np.ndarray
    cost: np.ndarray
    N: np.ndarray
    b: np.ndarray
    turns: np.ndarray

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
        """What the widths of z and t add to -2 ln p (j,)."""
        return np.linalg.slogdet(self.N)[1] + self.turns


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
    test, theory = model.data.test, model.problem.theory
    has = np.isfinite(test.shapes)
    modes = np.flatnonzero(np.isfinite(test.frequency_hz) & (has.sum(axis=0) >= 2))
    has, hz = has[:, modes], test.frequency_hz[modes]
    y = np.where(has, test.shapes[:, modes], 0.0)
    sd = np.hypot(test.shape_sd[:, modes], theory.shape * np.abs(y).max(axis=0, initial=0.0))
    weight, at = np.where(has, 1 / np.where(has, sd, 1.0), 0.0), eigenvalue(hz)
    off = np.hypot(test.frequency_sd_hz[modes] / hz, theory.frequency)
    return Shapes(modes, at, 2 * off * at, y * weight, weight, int(has.sum()) - len(modes))


class Matcher:
    """The model at z (k,), in its own modes: X (r, r), eigenvalues (r,), what sensors see (s, r), dK and dM by z (k, r, r)."""

    def __init__(self, model: Reduced, measured: Shapes, z: np.ndarray, whitening: list[np.ndarray] | None = None):
        """whitening: for each mode (s, s), when components are not independent."""
        self.measured, self.z, self._whitening = measured, z, whitening
        K, M = model.matrices(z)
        C = np.linalg.inv(np.linalg.cholesky(M))
        self.eigenvalues, Q = np.linalg.eigh(C @ K @ C.T)
        self.X = C.T @ Q
        self.seen = model.sensing @ self.X
        self._reach = min(len(self.eigenvalues), int(model.data.test.number.max()) + 1)
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
        cost, volume = np.full(j, self.z @ self.z), np.zeros(j)
        for i in range(len(self.measured.modes)):
            t, _, _, own = self.nearest(i, B)
            r, e, J = self._derivatives(i, t, B)
            spread = 1 + np.einsum("js,js->j", e, e)
            eJ = np.einsum("js,jsk->jk", e, J)
            off = (np.einsum("js,js->j", e, r) - t) / spread  # what is left to go in t
            parts = (
                np.einsum("js,js->j", r, r) + t**2,
                np.swapaxes(J, 1, 2) @ J - eJ[:, :, None] * eJ[:, None, :] / spread[:, None, None],
                np.einsum("jsk,js->jk", J, r) - eJ * off[:, None],
                np.log(spread),
            )
            if own.any():
                for part, value in zip(parts, self._unmoved(i), strict=True):
                    part[own] = value
            for total, part in zip((cost, N, b, volume), parts, strict=True):
                total += part
        return Matches(np.zeros((j, k)) + self.z, cost, N, b, volume)

    def _own(self, i: int) -> tuple[int, float, float]:
        """The mode of the model that measured mode i would be if nothing acted on it, how far off it is (sd), and the cost."""
        S, y = self._seen(i), self.y(i)
        size = np.maximum(np.einsum("sr,sr->r", S, S), 1e-300)
        t = (self.eigenvalues - self.measured.eigenvalue[i]) / self.measured.sd[i]
        cost = y @ y - (S.T @ y) ** 2 / size + t**2
        p = int(np.argmin(cost))
        return p, float(t[p]), float(cost[p])

    def _unmoved(self, i: int) -> tuple[float, np.ndarray, np.ndarray, float]:
        """Cost, half its curvature (k, k), J'r (k,) and no volume for measured mode i as the model's own."""
        p, t, cost = self._own(i)
        S, y = self._seen(i), self.y(i)
        h = S[:, p] / np.linalg.norm(S[:, p])
        G = self.dK[:, :, p] - self.eigenvalues[p] * self.dM[:, :, p]
        apart = self._apart(self.eigenvalues[p])
        share = -G / apart
        share[:, p] = -0.5 * self.dM[:, p, p]
        J = (h @ y) / np.linalg.norm(S[:, p]) * (S @ share.T)
        J = np.vstack([J - np.outer(h, h @ J), G[:, p] / self.measured.sd[i]])
        r = np.append(y - (h @ y) * h, -t)
        return cost, J.T @ J, J.T @ r, 0.0

    def _seen(self, i: int) -> np.ndarray:
        seen = self.seen * self.measured.weight[:, i, None]
        return seen if self._whitening is None else self._whitening[i] @ seen

    def y(self, i: int) -> np.ndarray:
        """The shape (s,) of mode i, over its standard deviations."""
        return self.measured.y[:, i] if self._whitening is None else self._whitening[i] @ self.measured.y[:, i]

    def _apart(self, at: np.ndarray) -> np.ndarray:
        """eigenvalues - lambda (..., r), never zero, for lambda `at` (...)."""
        at = np.asarray(at)[..., None]
        apart = self.eigenvalues - at
        least = _POLE * np.abs(at)
        return np.where(np.abs(apart) < least, np.where(apart < 0, -least, least), apart)

    def nearest(self, i: int, B: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
        """t (j,) for which a h comes nearest to y, for rows B (j, r) in own modes; the least cost (j,); h/|h| (j, s).

        And where the mode is the model's own instead (j,).
        """
        y, apart = self.y(i), self.eigenvalues - self.measured.eigenvalue[i]
        pole = int(np.argmin(np.abs(apart)))
        fixed = 1 / self._apart(self.measured.eigenvalue[i])
        fixed[pole] = 0.0
        others = B @ (self._seen(i) * fixed).T
        u = apart[pole] * others + B[:, pole, None] * self._seen(i)[:, pole]
        v = -self.measured.sd[i] * others
        uu, uv, vv = (np.einsum("js,js->j", a, b) for a, b in ((u, u), (u, v), (v, v)))
        uy, vy = u @ y, v @ y

        def misfit(t: np.ndarray) -> np.ndarray:
            size = np.maximum(
                uu + t * (2 * uv + t * vv), _VANISHED * (uu + t**2 * vv)
            )  # u + t v may vanish but for rounding
            return t**2 - (uy + t * vy) ** 2 / np.maximum(size, 1e-300)

        with np.errstate(divide="ignore", invalid="ignore"):
            alike = np.nan_to_num((vy * uu - uy * uv) / (uy * vv - vy * uv), posinf=0.0, neginf=0.0)
        starts = [np.full(len(B), t) for t in _STARTS] + [np.clip(alike, -_WIDEST, _WIDEST)]
        t = _least(misfit, np.array(starts))
        h, cost = u + t[:, None] * v, y @ y + misfit(t)
        h /= np.sqrt(np.maximum(np.einsum("js,js->j", h, h), 1e-300))[:, None]
        p, _, alone = self._own(i)
        own = (np.abs(B[:, p]) < _NODE * np.abs(B[:, : self._reach]).max(axis=1)) & (alone < cost)
        cost[own], h[own] = alone, self._seen(i)[:, p] / np.linalg.norm(self._seen(i)[:, p])
        return t, cost, h, own

    def _derivatives(self, i: int, t: np.ndarray, B: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Misfit r (j, s) of mode i at t (j,); by how much t and z move what it is compared with: e (j, s), J (j, s, k)."""
        at = self.measured.eigenvalue[i] + t * self.measured.sd[i]
        D, S, y = 1 / self._apart(at), self._seen(i), self.y(i)
        BD = B * D
        h = BD @ S.T
        size = np.sqrt(np.maximum(np.einsum("js,js->j", h, h), 1e-300))
        a, unit = (h @ y) / size**2, h / size[:, None]
        BD *= a[:, None]
        e = self.measured.sd[i] * ((BD * D) @ S.T)
        e -= unit * np.einsum("js,js->j", unit, e)[:, None]
        J = -self._moved(i, BD, D)
        J -= unit[:, :, None] * np.einsum("js,jsk->jk", unit, J)[:, None, :]
        return y - a[:, None] * h, e, J

    def _moved(self, i: int, BD: np.ndarray, D: np.ndarray) -> np.ndarray:
        """S R (dK - lambda dM) R B (j, s, k) for rows BD (j, r) of R B; of the left R only the nearest pole follows t."""
        at, S = self.measured.eigenvalue[i], self._seen(i)
        pole = int(np.argmin(np.abs(self.eigenvalues - at)))
        fixed = 1 / self._apart(at)
        fixed[pole] = 0.0
        dZ = self.dK - at * self.dM
        (j, r), s, k = BD.shape, len(S), len(self.z)
        J = (BD @ np.swapaxes(dZ @ (S * fixed).T, 0, 1).reshape(r, k * s)).reshape(j, k, s)
        J += ((BD @ dZ[:, :, pole].T) * D[:, pole, None])[:, :, None] * S[:, pole]
        return np.swapaxes(J, 1, 2)


def _least(f, starts: np.ndarray) -> np.ndarray:
    """For each place the t of least f(t) (j,), from the best of `starts` (c, j), by halving steps."""
    values = np.array([f(t) for t in starts])
    best = np.argmin(values, axis=0)
    t, least = starts[best, np.arange(starts.shape[1])], values.min(axis=0)
    width = 0.5
    for _ in range(_HALVINGS):
        for side in (-width, width):
            there = f(t + side)
            t, least = np.where(there < least, t + side, t), np.minimum(there, least)
        width /= 2
    return t
