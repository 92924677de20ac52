"""The modal test as observable: eigenvalues and mode-shape components, in the order of the card deck."""

from dataclasses import dataclass

import numpy as np

from mouse_cli.dynamics.correlation import least_squares_scale
from mouse_cli.dynamics.eigen import EigenSolution
from mouse_cli.dynamics.frequency import eigenvalue, sd_eigenvalue
from mouse_cli.dynamics.sensing import restricted
from mouse_cli.dynamics.sensitivity import ModalPartials
from mouse_cli.model.arrays import Matrix, dense
from mouse_cli.model.modal_test import ModalTest

UNRELATED = 0.1  # least ratio |c t| / |x| of a test vector that has anything to do with the theory's


@dataclass(frozen=True)
class ModalObservable:
    """y = (lambda of every mode; then mode 1 at its points, mode 2, ...) with its standard deviations.

    shapes, shape_sd (s, m): the test vectors at the scale of the theory, NaN where not measured; factor (m,): what they
    were multiplied by, sign included. mass (s, s): M restricted to the measured points.
    """

    test: ModalTest
    shapes: np.ndarray
    shape_sd: np.ndarray
    factor: np.ndarray
    mass: np.ndarray

    @property
    def fitted(self) -> bool:
        """Whether the scale of every shape is fitted along with the parameters."""
        return self.test.scale == "fitted"

    @property
    def has_frequency(self) -> np.ndarray:
        """Mask (m,) of the modes whose frequency was measured."""
        return np.isfinite(self.test.frequency_hz)

    @property
    def has_shape(self) -> np.ndarray:
        """Mask (s, m) of the measured components."""
        return np.isfinite(self.shapes)

    @property
    def scales_fitted(self) -> int:
        """Number of degrees of freedom that fitted scales take from the data."""
        return int(self.has_shape.any(axis=0).sum()) if self.fitted else 0

    def stacked(self, eigenvalues: np.ndarray, shapes: np.ndarray) -> np.ndarray:
        """Values (q, ...) of `eigenvalues` (m, ...) and `shapes` (m, s, ...) where there is a datum, in the order of y."""
        have = self.has_shape.T
        rows = shapes.reshape(have.size, *shapes.shape[2:]) if have.all() else shapes[have]
        return np.concatenate([eigenvalues[self.has_frequency], rows])

    def measured(self) -> tuple[np.ndarray, np.ndarray]:
        """y (q,) and its standard deviations (q,): lambda = (2 pi f)^2, sd_lambda = 8 pi^2 f sd_f."""
        f, sd = self.test.frequency_hz, self.test.frequency_sd_hz
        y = self.stacked(eigenvalue(f), self.shapes.T)
        return y, self.stacked(sd_eigenvalue(f, sd), self.shape_sd.T)

    def labels(self) -> list[str]:
        """Names of the data as the report writes them: `lambda 1`, `x(3,2)` = component of mode 3 at dof 2, or at a sensor."""
        names = [f"lambda {n}" for n, have in zip(self.test.number, self.has_frequency, strict=True) if have]
        places = self.test.sensors or [str(dof + 1) for dof in self.test.dofs]
        return names + [f"x({self.test.number[i]},{places[s]})" for i, s in np.argwhere(self.has_shape.T)]

    def theory(self, solution: EigenSolution, modes: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Model shapes (s, m) of the paired `modes` at the measured points, signed and scaled; and those factors (m,)."""
        shapes = self.test.read(solution.shapes[:, modes])
        have = self.has_shape
        x, t = np.where(have, shapes, 0.0), np.where(have, self.shapes, 0.0)
        if not self.fitted:
            factor = np.where(np.sum(x * (self.mass @ t), axis=0) < 0, -1.0, 1.0)
            return shapes * factor, factor
        w = np.where(have, self.shape_sd, 1.0) ** -2.0
        size = np.sum(x * w * x, axis=0)
        factor = np.divide(np.sum(x * w * t, axis=0), size, out=np.ones_like(size), where=size > 0)
        return shapes * factor, factor

    def partials(self, partials: ModalPartials, shapes: np.ndarray, factor: np.ndarray) -> np.ndarray:
        """B (q, e) in the order of y, for model `shapes` (s, m) with their `factor` (m,) as `theory` gives them.

        With fitted scales the direction of each shape itself is projected out (variable projection, Golub and Pereyra
        1973): what a change of scale explains says nothing of the parameters. Works in the memory of `partials`.
        """
        d_shape, have = partials.d_shape, self.has_shape
        d_shape *= factor[:, None, None]
        for i in np.flatnonzero(have.any(axis=0)) if self.fitted else ():
            x = np.where(have[:, i], shapes[:, i], 0.0)
            w = np.where(have[:, i], self.shape_sd[:, i], 1.0) ** -2.0
            size = float(x @ (w * x))
            if size > 0:
                d_shape[i] -= np.outer(x, (w * x) @ d_shape[i]) / size
        kept = np.concatenate([self.has_frequency, have.T.ravel()])
        return partials.values if kept.all() else partials.values[kept]


def observe(test: ModalTest, M: Matrix, solution: EigenSolution, modes: np.ndarray) -> ModalObservable:
    """The observable of `test`, its shapes renormalised once to the model's `modes` (m,) of `solution`.

    Scale `least-squares` (and the start of `fitted`): c = x'Mt / t'Mt over the measured points; `unit`: t'Mt = 1, signed;
    `none`: as punched. Accuracies are scaled with the shapes. Raises UnrelatedShapes when c would be about 0.
    """
    mass = dense(restricted(test.measured_at, M))
    theory = test.read(solution.shapes[:, modes])
    factor = np.array([_factor(test, mass, theory[:, i], i) for i in range(test.m)])
    return ModalObservable(test, test.shapes * factor, test.shape_sd * np.abs(factor), factor, mass)


class UnrelatedShapes(ValueError):
    """A test vector has nothing in common with the model's mode of that number; `mode` counts from 0."""

    def __init__(self, mode: int, ratio: float):
        super().__init__(f"test mode {mode + 1}: |c t| / |x| = {ratio:.3g}")
        self.mode, self.ratio = mode, ratio


def _factor(test: ModalTest, mass: np.ndarray, x: np.ndarray, i: int) -> float:
    """Renormalisation factor of test vector i."""
    have = np.isfinite(test.shapes[:, i])
    if test.scale == "none" or not have.any():
        return 1.0
    x, t, mass = x[have], test.shapes[have, i], mass[np.ix_(have, have)]
    length = np.sqrt(max(t @ mass @ t, 0.0))
    if length == 0:
        raise UnrelatedShapes(i, 0.0)
    c = least_squares_scale(x, t, mass)
    size = np.sqrt(max(x @ mass @ x, 0.0))
    ratio = abs(c) * length / size if size > 0 else 0.0
    if ratio < UNRELATED:
        raise UnrelatedShapes(i, ratio)
    return c if test.scale != "unit" else float(np.copysign(1.0 / length, c))
