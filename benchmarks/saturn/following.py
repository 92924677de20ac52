"""Causes that follow the stiffness of the bars that they act on.

A cause such as shear changes a bar by an amount that depends on the bar's own EI. Where the deck's parameters move EI by
factors, the change must move too: K(theta) = K_0 + sum_j (theta_j - theta_0j) dK/dtheta_j, exact for factors on Young's
modulus, in which bars are linear.
"""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from mouse_cli.diagnosis.candidates import Candidate
from mouse_cli.diagnosis.change import Change, Recipe
from mouse_cli.diagnosis.fit import Model, Point
from mouse_cli.diagnosis.reduced import Reduced

_STEP = 0.05  # of a factor; any will do where the change is linear in it
_SMALL = 1e-5  # of the range of an unknown, for derivatives


class Following(Model):
    """A model with one cause, at `place` among those of its candidate, whose change is that of the bars at every z.

    For tests without shapes.
    """

    def __init__(self, base: Reduced, candidate: Candidate, recipe: Recipe, place: int):
        super().__init__(base, (recipe,))
        self._theta, self._steps = base.theta, _STEP * base.theta
        self._moved: list[Model] = []
        for step in np.diag(self._steps):
            moved = replace(base, theta=base.theta + step)
            self._moved.append(Model(moved, (candidate.recipes(moved, candidate)[place],)))

    def point(self, x: np.ndarray) -> Point | None:
        """The model at x (k + t,)."""
        self._theta = self.base.parameters(x[: self.k])
        return super().point(x)

    def added(self, c: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """K, M (size, size) and sensing (0, size) that the cause adds at c and at the last z."""
        K, M, sensing = super().added(c)
        dK, dM = self._slopes(c)
        step = self._theta - self.base.theta
        return K + np.tensordot(step, dK, 1), M + np.tensordot(step, dM, 1), sensing

    def jacobian(self, at: Point) -> np.ndarray:
        """d(prediction)/dx, with what the change of the cause adds to the effect of z."""
        base, z = self.base, at.x[: self.k]
        self._theta = base.parameters(z)
        T = super().jacobian(at)
        (dK, dM), X, eigenvalues = self._slopes(at.x[self.k :]), at.X[:, at.modes], at.eigenvalues[at.modes]
        by = base.coordinates.slope(base.coordinates.mean + base.L @ z)[:, None] * base.L
        d = [np.einsum("rm,rm->m", X, k @ X - (m @ X) * eigenvalues) for k, m in zip(dK, dM, strict=True)]
        still = np.zeros((*at.seen[:, at.modes].shape, self.k))
        T[:, : self.k] += base.data.jacobian(eigenvalues, at.seen[:, at.modes], at.a, np.array(d).T @ by, still)
        return T

    def _slopes(self, c: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """d(change of K)/dtheta and d(change of M)/dtheta (p, size, size)."""
        K, M, _ = super().added(c)
        moved = [model.added(c) for model in self._moved]
        return tuple(
            np.array([(one[i] - here) / step for one, step in zip(moved, self._steps, strict=True)])
            for i, here in enumerate((K, M))
        )

    def _derivatives(self, c: np.ndarray) -> Iterator[tuple[int, Change]]:
        """0 and d(change)/dc for each unknown."""
        for j, h in enumerate(_SMALL * self.width):
            ends = [c.copy(), c.copy()]
            ends[0][j], ends[1][j] = np.clip([c[j] - h, c[j] + h], *self.bounds[j])
            (K0, M0, _), (K1, M1, _) = (self.added(end) for end in ends)
            length = ends[1][j] - ends[0][j]
            yield 0, Change((K1 - K0) / length, (M1 - M0) / length)
