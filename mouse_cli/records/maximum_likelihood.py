"""Maximum-likelihood fit of the modal model, and the covariance of its poles and shapes.

Gauss-Newton with the linear part projected out (L. Kaufman, BIT 15 (1975) 49): with P_o the projector off the columns of
output o, the step of poles and participations is (sum_o G_o' P_o G_o)^-1 sum_o G_o' P_o r_o. The errors of H are weighted by
their sd, so that the minimum is the maximum of the likelihood for independent circular normal errors (R. Pintelon,
J. Schoukens, System Identification, 2nd ed. 2012, section 9.11).
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from mouse_cli.records.modal_model import Lines, ModalModel, Output, lsfd, partial_fractions, solved, stacked

_ITERATIONS, _SMALL = 25, 1e-6
_FARTHEST = 3.0  # decay rates that a pole moves in one step: beyond, the slope says nothing of it
_NEGLIGIBLE = 1e-4  # fall of chi2: it moves no unknown by more than a hundredth of its sd
ROUGH = 1e-4  # of chi2: a fall that decides nothing while it is not settled which poles are modes


@dataclass(frozen=True)
class Fit:
    """A fitted model; chi2: sum of squares of weighted errors; free: how many values less how many unknowns."""

    model: ModalModel
    chi2: float
    free: int

    @property
    def misfit(self) -> float:
        """chi2 over its expectation: 1 where the stated sd hold."""
        return self.chi2 / max(self.free, 1)


def unknowns(model: ModalModel) -> int:
    """How many real numbers the model has."""
    outputs, inputs = model.residuals.shape[1:]
    return 2 * model.m * (outputs + inputs) + model.residuals.size


def fitted(lines: Lines, model: ModalModel, iterations: int = _ITERATIONS, small: float = _SMALL) -> Fit:
    """The maximum of the likelihood from `model` on. Levenberg-Marquardt: a step that raises chi2 is shortened.

    small: share of chi2 by which a step has to lower it for another one.
    """
    model, chi2 = solved(lines, model)
    damping, free = 1e-3, 2 * lines.values - unknowns(model)
    for _ in range(iterations if model.m else 0):
        normal, gradient = reduced(lines, model)
        tried, lower, damping = _step(lines, model, chi2, normal, gradient, damping)
        if tried is None:
            break
        gain, model, chi2 = chi2 - lower, tried, lower
        if gain <= small * chi2 + _NEGLIGIBLE:
            break
    return Fit(model, chi2, free)


def _step(
    lines: Lines, model: ModalModel, chi2: float, normal: np.ndarray, gradient: np.ndarray, damping: float
) -> tuple[ModalModel | None, float, float]:
    """The first step that lowers chi2, that chi2 and the damping for the next; None where no step does."""
    size = np.sqrt(np.where(np.diag(normal) > 0, np.diag(normal), 1.0))
    scaled = normal / np.outer(size, size)
    for _ in range(12):
        step = np.linalg.solve(scaled + damping * np.eye(len(size)), gradient / size) / size
        tried, lower = solved(lines, moved(model, step))
        if lower < chi2:
            return tried, lower, damping / 10
        if chi2 - lower > -1e-12 * chi2:
            break
        damping = max(damping * 8, 1e-6)
    return None, chi2, damping


def moved(model: ModalModel, step: np.ndarray) -> ModalModel:
    """The model with its poles and participations changed by `step`, in the order of `slopes`; poles stay above the real axis."""
    change = step[0::2] + 1j * step[1::2]
    m = model.m
    most = _FARTHEST * np.maximum(np.abs(model.poles.real), 1e-6 * np.abs(model.poles))
    change[:m] *= np.minimum(1, most / np.maximum(np.abs(change[:m]), 1e-300))
    poles = model.poles + change[:m]
    poles = np.where(poles.imag > 0, poles, model.poles)
    participation = model.participation.copy()
    rows, columns = free_participations(model.participation)
    participation[rows, columns] += change[m:]
    return replace(model, poles=poles, participation=participation)


def free_participations(participation: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Rows and columns of what is not held at 1: all but one input of each mode."""
    held = np.abs(participation).argmax(axis=0)
    rows, columns = np.nonzero(np.arange(participation.shape[0])[:, None] != held)
    return rows, columns


@dataclass(frozen=True)
class Slopes:
    """dH to the unknowns, poles then free participations, without the shapes: p, q (f, i, k) of a real shape and of i times it.

    columns (k,): mode of each unknown.
    """

    p: np.ndarray
    q: np.ndarray
    columns: np.ndarray

    def of(self, shape: np.ndarray, weight: np.ndarray) -> np.ndarray:
        """weight dH of one output (2 f i, 2 k), stacked: to real and imaginary parts of the unknowns by turns."""
        factor = shape[self.columns]
        p, q = (stacked(weight[:, :, None] * part) for part in (self.p, self.q))
        found = np.empty((*p.shape, 2))
        found[:, :, 0], found[:, :, 1] = factor.real * p + factor.imag * q, factor.real * q - factor.imag * p
        return found.reshape(len(p), -1)


def slopes(lines: Lines, model: ModalModel) -> Slopes:
    """Those of the model: with x of a shape and a participation, d/da of x (a + i b) + its mirror is p, d/db is q."""
    b, c = partial_fractions(lines.s, lines.kind, model.poles)
    d, e = partial_fractions(lines.s, lines.kind, model.poles, 2)
    poles = [
        part[:, None, :] * l for part, l in zip((d, e), (model.participation, model.participation.conj()), strict=True)
    ]
    rows, columns = free_participations(model.participation)
    place = (np.arange(model.participation.shape[0])[:, None] == rows).astype(float)
    inputs = [part[:, None, columns] * place for part in (b, c)]
    forward, mirrored = (np.concatenate(pair, axis=2) for pair in zip(poles, inputs, strict=True))
    return Slopes(forward + mirrored, 1j * (forward - mirrored), np.concatenate([np.arange(model.m), columns]))


def per_output(lines: Lines, model: ModalModel) -> Iterator[tuple[Output, np.ndarray]]:
    """Each output's linear part, and its weighted slopes (2 f i, t)."""
    base, weight = slopes(lines, model), lines.weight
    for o, found in enumerate(lsfd(lines, model)):
        shape = found.solution[: model.m] + 1j * found.solution[model.m : 2 * model.m]
        yield found, base.of(shape, weight[:, o])


def reduced(lines: Lines, model: ModalModel) -> tuple[np.ndarray, np.ndarray]:
    """sum_o G_o' P_o G_o (t, t) and sum_o G_o' P_o r_o (t,)."""
    normal = gradient = 0.0
    for found, slope in per_output(lines, model):
        free = found.off(slope)
        normal, gradient = normal + free.T @ free, gradient + free.T @ found.remainder
    return normal, gradient
