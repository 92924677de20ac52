"""Modes so close that errors of theory turn them into one another: what a prediction of their shapes is to be allowed.

An error E of K - lambda M, in coordinates of the modes, turns mode i by E_ij / (lambda_i - lambda_j) towards mode j.
Where ln f of a mode has an error of sd tau, E_ii has 2 tau lambda_i; in a random symmetric matrix without a preferred direction an
element beside the diagonal has half the variance of one on it (Mehta, Random Matrices, 2.5), so that the angle has

    sd = sqrt(2) tau lambda / |lambda_i - lambda_j|.

With U (q, c) what each such angle does to the whitened data, one sd of it, these are whitened by (I + U U')^-1/2. The length of a
shape is free, so that phi_i + t phi_j is every combination of the two; each mode has a t of its own, for lengths are fitted first.
"""

from dataclasses import dataclass, field

import numpy as np

from mouse_cli.diagnosis.likelihoods.modal.model import Model
from mouse_cli.diagnosis.likelihoods.modal.point import Point

_COVERED = 0.02  # angle up to which `theory.shape` allows for it, and what a test states


@dataclass(frozen=True)
class Turned(Point):
    """A point whose residual is whitened by angles between modes too: along `axes` (q, c), orthonormal, of `sizes` (c,)."""

    axes: np.ndarray = field(repr=False)
    sizes: np.ndarray = field(repr=False)

    @property
    def nats(self) -> float:
        """1/2 ln |I + U U'|: by what the density is lower for that."""
        return float(0.5 * np.log1p(self.sizes**2).sum())

    def whitened(self, values: np.ndarray) -> np.ndarray:
        """(I + U U')^-1/2 times values (q, ...)."""
        less = 1 - 1 / np.sqrt(1 + self.sizes**2)
        return values - (self.axes * less) @ (self.axes.T @ values)


class Turning(Model):
    """A model that predicts close modes but for how they turn into one another."""

    def paired(self, x: np.ndarray, eigenvalues: np.ndarray, X: np.ndarray, S: np.ndarray) -> Point | None:
        """Those modes beside the test; None where it has modes that are none of theirs."""
        at = super().paired(x, eigenvalues, X, S)
        U = None if at is None else self._turns(at)
        if U is None:
            return at
        axes, sizes, _ = np.linalg.svd(U, full_matrices=False)
        own = Turned(**vars(at), axes=axes, sizes=sizes)
        return Turned(**{**vars(own), "residual": own.whitened(at.residual)})

    def _jacobian(self, at: Point) -> np.ndarray:
        found = super()._jacobian(at)
        return at.whitened(found) if isinstance(at, Turned) else found

    def _turns(self, at: Point) -> np.ndarray | None:
        """U (q, c), see above; None: no modes are so close, or nothing is seen of their shapes."""
        data, lam = self.base.data, at.eigenvalues
        apart = lam[at.modes][:, None] - lam
        apart[np.arange(len(at.modes)), at.modes] = np.inf
        apart[apart == 0] = 1e-300
        sd = np.sqrt(2) * data.theory[:, None] * lam[at.modes][:, None] / np.abs(apart)
        columns = []
        for i, j in np.argwhere(sd > _COVERED).tolist():
            moved = np.zeros((data.s, data.m))
            moved[:, i] = min(np.sqrt(sd[i, j] ** 2 - _COVERED**2), 1.0) * at.seen[:, j]
            columns.append(moved)
        if not columns or not data.s:
            return None
        still, moved = np.zeros((data.m, len(columns))), np.stack(columns, axis=2)
        return data.jacobian(lam[at.modes], at.seen[:, at.modes], at.a, still, moved)
