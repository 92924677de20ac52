"""A model with one force of an unknown law: at its place each measured mode has a stiffness of its own.

Mode n is that of K + d_n B'B, d_n = s v_n w_n with w_n ~ N(0, 1): the values of a law that depends on frequency, or on the
amplitude with which the place moves in that mode. See `localise/implied_law.py`, which reads them off each frequency.
"""

from dataclasses import dataclass

import numpy as np

from mouse_cli.diagnosis.likelihoods.modal.model import Model, modes_of
from mouse_cli.diagnosis.likelihoods.modal.point import Point
from mouse_cli.diagnosis.nameless._field import Fielded


@dataclass(frozen=True, kw_only=True)
class Lawful(Fielded):
    """A reduced model with such a force through the row B (r,); numbers (w,): modes that its values are of."""

    row: np.ndarray
    numbers: np.ndarray


@dataclass(frozen=True, kw_only=True)
class ByMode(Point):
    """A point of such a model: of each measured mode the model that it is a mode of, and which one."""

    each: tuple[tuple[np.ndarray, np.ndarray, int], ...]


class OneLaw(Model):
    """What it predicts, and by which derivatives: one eigensolution for each measured mode."""

    def point(self, x: np.ndarray) -> ByMode | None:
        """The model at x (k + t,); None where it is not physical."""
        base, r = self.base, self.base.r
        K, M, S = self.added(x)
        K0, M0 = base.matrices(x[: self.k])
        K[:r, :r] += K0
        M[:r, :r] += M0
        S[:, :r] += base.sensing
        values, each = base.nameless.values(x[base.deck : self.k]), []
        for i, number in enumerate(base.data.test.number):
            own = K.copy()
            own[:r, :r] += values[base.numbers == number].sum() * np.outer(base.row, base.row)
            eigenvalues, X = modes_of(own, M.copy())
            if not np.isfinite(eigenvalues).all():
                return None
            eigenvalues, X = base.refined(eigenvalues, X)
            p = int(base.data.pair(eigenvalues, S @ X)[i])
            if p >= len(eigenvalues) or eigenvalues[p] <= 0:
                return None
            each.append((eigenvalues, X, p))
        lam = np.array([eigenvalues[p] for eigenvalues, _, p in each])
        shapes = np.stack([X[:, p] for _, X, p in each], axis=1)
        residual, a = base.data.residual(lam, S @ shapes)
        return ByMode(x, lam, shapes, S @ shapes, np.arange(len(lam)), residual, a, each=tuple(each))

    def loosened(self, at: ByMode, share: float) -> None:
        """None: a value of its own in each mode makes up for its theory."""

    def jacobian(self, at: ByMode) -> np.ndarray:
        """d(prediction)/dx (q, k + t), whitened; t is 0: no mechanism is beside."""
        base, data, r = self.base, self.base.data, self.base.r
        dK, dM = base.slopes(at.x[: self.k])
        d_lambda = np.zeros((len(at.each), self.k))
        d_seen = np.zeros((*at.seen.shape, self.k))
        for i, (eigenvalues, X, p) in enumerate(at.each):
            x, lam = X[:r, p], eigenvalues[p]
            inertia = dM @ x
            forces = dK @ x - lam * inertia
            own = base.numbers == data.test.number[i]
            forces[base.deck :] += base.nameless.P.T @ own[:, None] * (base.row @ x) * base.row
            G = forces @ X[:r]
            apart = lam - eigenvalues
            apart[np.abs(apart) < 1e-9 * abs(lam)] = np.inf
            seen = base.sensing @ X[:r]
            d_lambda[i] = G[:, p]
            d_seen[:, i] = seen @ (G / apart).T - 0.5 * np.outer(seen[:, p], inertia @ x)
        return data.jacobian(at.eigenvalues, at.seen, at.a, d_lambda, d_seen)
