"""The modal model of frequency response functions, its linear least-squares part (LSFD) and its derivatives.

H(s) = s^k { sum_r [ psi_r l_r^T / (s - lambda_r) + conjugate ] + sum_p R_p s^p },  s = i w, k = 0 receptance, 1 mobility,
2 accelerance; R_p real: p = -2 stands for the modes below the band, 0 for those above it, 2 for their curvature
(W. Heylen, S. Lammens, P. Sas, Modal Analysis Theory and Testing, 1997, section A.3.2.5).
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

BELOW, ABOVE, CURVED = -2, 0, 2  # powers of s of the residual terms
_WORST = 1e9  # condition number of normal equations from which on a QR factorisation is made


@dataclass(frozen=True)
class Lines:
    """Measured values at lines: s (f,) = i omega, rad/s; H (f, o, i), 0 where not measured; sd (f, o, i) of a complex value.

    An infinite sd marks what was not measured. kind: power k of s that receptance is multiplied by.
    """

    s: np.ndarray
    H: np.ndarray
    sd: np.ndarray
    kind: int

    @property
    def weight(self) -> np.ndarray:
        """1 / sd of a real or of an imaginary part (f, o, i)."""
        return np.sqrt(2) / self.sd

    @property
    def values(self) -> int:
        """How many complex values were measured."""
        return int(np.isfinite(self.sd).sum())


@dataclass(frozen=True)
class ModalModel:
    """poles (m,) rad/s, upper half plane; participation (i, m), largest component 1; shapes (o, m).

    residuals (t, o, i): real factors of `powers` of s.
    """

    poles: np.ndarray
    participation: np.ndarray
    shapes: np.ndarray
    residuals: np.ndarray
    powers: tuple[int, ...]

    @property
    def m(self) -> int:
        """Number of modes."""
        return len(self.poles)

    def without(self, mode: int) -> "ModalModel":
        """The model without one of its modes."""
        keep = np.arange(self.m) != mode
        return replace(
            self, poles=self.poles[keep], participation=self.participation[:, keep], shapes=self.shapes[:, keep]
        )


def start(poles: np.ndarray, participation: np.ndarray, outputs: int, powers: tuple[int, ...]) -> ModalModel:
    """A model whose shapes and residual terms are still to be found."""
    inputs = participation.shape[0]
    return ModalModel(
        poles, participation, np.zeros((outputs, len(poles)), complex), np.zeros((len(powers), outputs, inputs)), powers
    )


def partial_fractions(s: np.ndarray, kind: int, poles: np.ndarray, power: int = 1) -> tuple[np.ndarray, np.ndarray]:
    """s^k / (s - lambda)^power and s^k / (s - conj lambda)^power, each (f, m)."""
    front = s[:, None] ** kind
    return front / (s[:, None] - poles) ** power, front / (s[:, None] - poles.conj()) ** power


def design(lines: Lines, model: ModalModel) -> np.ndarray:
    """What one output's H is linear in (f, i, 2 m + t i): real and imaginary parts of its shape components, residual terms."""
    b, c = partial_fractions(lines.s, lines.kind, model.poles)
    forward = b[:, None, :] * model.participation
    mirrored = c[:, None, :] * model.participation.conj()
    inputs = model.participation.shape[0]
    scale = np.abs(lines.s).max()
    residual = (lines.s[:, None] / scale) ** (lines.kind + np.array(model.powers, int))
    each = residual[:, None, :, None] * np.eye(inputs)[None, :, None, :]
    return np.concatenate(
        [forward + mirrored, 1j * (forward - mirrored), each.reshape(len(lines.s), inputs, -1)], axis=2
    )


def stacked(values: np.ndarray) -> np.ndarray:
    """Complex (f, i, ...) as real (2 f i, ...): real parts first."""
    flat = values.reshape(values.shape[0] * values.shape[1], *values.shape[2:])
    return np.concatenate([flat.real, flat.imag])


def complexed(rows: np.ndarray, lines: int, inputs: int) -> np.ndarray:
    """Real (..., 2 f i) back to complex (..., f, i)."""
    half = rows.shape[-1] // 2
    return (rows[..., :half] + 1j * rows[..., half:]).reshape(*rows.shape[:-1], lines, inputs)


@dataclass(frozen=True)
class Output:
    """One output's linear least squares min |data - design x|, weighted, real.

    columns (2 f i, p) span the design; middle (p, p): columns middle columns' projects on them; back (p, p):
    x = back columns' data. solution (p,); remainder (2 f i,) = data less its projection.
    """

    columns: np.ndarray
    middle: np.ndarray
    back: np.ndarray
    solution: np.ndarray
    remainder: np.ndarray

    def off(self, values: np.ndarray) -> np.ndarray:
        """Columns (2 f i, k) less their projections on the design."""
        return values - self.columns @ (self.middle @ (self.columns.T @ values))

    def inverse(self, rows: int) -> np.ndarray:
        """The first rows (rows, 2 f i) of the pseudo-inverse of the design."""
        return self.back[:rows] @ self.columns.T

    def rises(self, m: int) -> np.ndarray:
        """By how much the sum of squares (m,) grows without each of m modes: x_S' (C_SS)^-1 x_S, C = (design' design)^-1.

        G. A. F. Seber, A. J. Lee, Linear Regression Analysis, 2003, section 4.3. S: real and imaginary part of the mode's shape.
        """
        rows = self.inverse(2 * m)
        parts = np.stack([rows[:m], rows[m:]], axis=1)
        x = self.solution[: 2 * m].reshape(2, m).T[:, :, None]
        return (x.transpose(0, 2, 1) @ np.linalg.pinv(parts @ parts.transpose(0, 2, 1), hermitian=True) @ x).ravel()


def lsfd(lines: Lines, model: ModalModel) -> Iterator[Output]:
    """Weighted least squares of each output in turn, poles and participations held (LSFD)."""
    linear, weights = design(lines, model), lines.weight
    for output in range(lines.H.shape[1]):
        weight = weights[:, output]
        columns = stacked(weight[:, :, None] * linear)
        data = stacked(weight * lines.H[:, output])
        size = np.sqrt(np.einsum("kp,kp->p", columns, columns))
        columns /= np.where(size > 0, size, 1.0)
        gram = columns.T @ columns
        if np.linalg.cond(gram) < _WORST:
            middle = np.linalg.inv(gram)
            back = middle
        else:
            columns, triangle = np.linalg.qr(columns)
            middle, back = np.eye(len(triangle)), np.linalg.pinv(triangle, rcond=1e-12)
        back = back / np.where(size > 0, size, 1.0)[:, None]
        inner = columns.T @ data
        yield Output(columns, middle, back, back @ inner, data - columns @ (middle @ inner))


def solved(lines: Lines, model: ModalModel) -> tuple[ModalModel, float]:
    """The model with its shapes and residual terms, and the sum of squares chi2 that is left."""
    shapes, residuals, chi2 = np.empty_like(model.shapes), np.empty_like(model.residuals), 0.0
    for o, found in enumerate(lsfd(lines, model)):
        shapes[o] = found.solution[: model.m] + 1j * found.solution[model.m : 2 * model.m]
        residuals[:, o] = found.solution[2 * model.m :].reshape(residuals.shape[0], residuals.shape[2])
        chi2 += float(found.remainder @ found.remainder)
    return replace(model, shapes=shapes, residuals=residuals), chi2


def synthesised(lines: Lines, model: ModalModel) -> np.ndarray:
    """H of the model (f, o, i) at the lines."""
    linear = design(lines, model)
    columns = np.concatenate(
        [
            model.shapes.real.T,
            model.shapes.imag.T,
            model.residuals.transpose(0, 2, 1).reshape(-1, model.shapes.shape[0]),
        ]
    )
    return np.einsum("fip,po->foi", linear, columns)
