"""From fitted poles and residues, or from modes of a subspace, to modes as the answer gives them, with standard deviations.

Shapes are scaled, and turned to be as real as they can be, with the covariance that they keep.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from mouse_cli.model.identification import UNIT_LARGEST, UNIT_MASS, Modes
from mouse_cli.records.identify_frf import Found
from mouse_cli.records.maximum_likelihood import free_participations
from mouse_cli.records.modal_model import ModalModel, synthesised
from mouse_cli.records.ssi import UncertainMode

_HALF_RIGHT = 45.0  # degrees that phi_d^2 may be off the real axis
_SHARE = 5  # half-widths of a resonance within which the error of the fit is taken


@dataclass(frozen=True)
class Drive:
    """A driving point: response `output` is at force `input`; sign -1 where one of them looks backwards."""

    output: int
    input: int
    sign: int = 1


def frequency_and_damping(pole: np.ndarray) -> np.ndarray:
    """|lambda| / 2 pi, Hz, and -Re lambda / |lambda| of real and imaginary part."""
    size = np.hypot(*pole)
    return np.array([size / (2 * np.pi), -pole[0] / size])


def from_fit(found: Found, picked: np.ndarray, drives: list[Drive], stable: np.ndarray) -> tuple[Modes, list[float]]:
    """The modes `picked` of a fit, and the angles, degrees, of their driving points."""
    model, m = found.fit.model, len(picked)
    inputs, outputs = model.participation.shape[0], len(model.shapes)
    parts = [_one(model, int(r), found.covariance.modes[int(r)], drives, inputs, outputs) for r in picked]
    places = np.stack([2 * picked, 2 * picked + 1], axis=1).ravel().astype(int)
    poles = np.stack([model.poles.real, model.poles.imag], axis=1).ravel()[places]
    both = lambda x: (
        np.stack([frequency_and_damping(x[2 * r : 2 * r + 2]) for r in range(m)], axis=1).ravel() if m else x
    )
    value, covariance = propagated(both, poles, found.covariance.poles[np.ix_(places, places)])
    hz, zeta = value[:m], value[m:]
    measured = found.lines.s.imag / (2 * np.pi)
    spacing = np.interp(hz, measured, np.gradient(measured))
    modes = _modes(value, covariance, parts, stable, 2 * zeta * hz / spacing, _errors(found, picked))
    return modes, [part.angle for part in parts]


@dataclass(frozen=True)
class Shape:
    """One mode's shape (o,), sd of its parts (o,), scale, and the angle of its driving point, NaN without one."""

    shape: np.ndarray
    real_sd: np.ndarray
    imaginary_sd: np.ndarray
    scale: str
    angle: float = float("nan")


def _modes(
    value: np.ndarray, covariance: np.ndarray, parts: list[Shape], stable: np.ndarray, lines: np.ndarray, error: np.ndarray
) -> Modes:  # fmt: skip
    m, sd = len(parts), np.sqrt(np.maximum(np.diag(covariance), 0))
    columns = lambda name: np.array([getattr(part, name) for part in parts]).T
    shapes = columns("shape")
    return Modes(
        value[:m], sd[:m], value[m:], sd[m:], covariance, shapes, columns("real_sd"), columns("imaginary_sd"),
        collinearity(shapes), tuple(part.scale for part in parts), stable, lines, error,
    )  # fmt: skip


def _one(model: ModalModel, r: int, covariance: np.ndarray, drives: list[Drive], inputs: int, outputs: int) -> Shape:
    """The shape of one mode of a fit: at unit modal mass where a driving point was measured and has the right sign."""
    rows, columns = free_participations(model.participation)
    free = rows[columns == r]
    vector = np.concatenate([[model.poles[r]], model.participation[free, r], model.shapes[:, r]])
    at = np.stack([vector.real, vector.imag], axis=1).ravel()

    def split(x: np.ndarray) -> tuple[complex, np.ndarray, np.ndarray]:
        values = x[0::2] + 1j * x[1::2]
        participation = model.participation[:, r].copy()
        participation[free] = values[1 : 1 + len(free)]
        return values[0], participation, values[1 + len(free) :]

    angle, drive = _driven(model, r, drives)
    if drive is not None:
        shaped = lambda x: _mass_scaled(*split(x), drive)
        return _spread(shaped, at, covariance, UNIT_MASS, angle)
    factor = _to_largest(model.shapes[:, r])
    return _spread(lambda x: factor * unit_length(split(x)[2]), at, covariance, UNIT_LARGEST, angle)


def _driven(model: ModalModel, r: int, drives: list[Drive]) -> tuple[float, Drive | None]:
    """The angle at the driving point that moves most, and that point where the angle is small."""
    if not drives:
        return float("nan"), None
    size = [abs(model.shapes[d.output, r] * model.participation[d.input, r]) for d in drives]
    best = drives[int(np.argmax(size))]
    residue = best.sign * model.shapes[best.output, r]
    angle = drive_angle(model.poles[r], model.participation[best.input, r], residue)
    return angle, best if abs(angle) < _HALF_RIGHT else None


def _mass_scaled(pole: complex, participation: np.ndarray, shape: np.ndarray, drive: Drive) -> np.ndarray:
    return unit_mass(pole, drive.sign * participation[drive.input], shape, drive.output)


def _to_largest(shape: np.ndarray) -> float:
    """1 over the largest real part of the shape at unit length."""
    return float(1 / np.abs(unit_length(shape).real).max())


def _spread(function, at: np.ndarray, covariance: np.ndarray, scale: str, angle: float = float("nan")) -> Shape:
    parts = lambda x: (lambda shape: np.concatenate([shape.real, shape.imag]))(function(x))
    value, spread = propagated(parts, at, covariance)
    sd, half = np.sqrt(np.maximum(np.diag(spread), 0)), len(value) // 2
    return Shape(value[:half] + 1j * value[half:], sd[:half], sd[half:], scale, angle)


def _errors(found: Found, picked: np.ndarray) -> np.ndarray:
    """For each mode the root mean square error of the fit near it, over that of what was measured there."""
    known = np.isfinite(found.lines.sd)
    error = np.abs(np.where(known, found.lines.H - synthesised(found.lines, found.fit.model), 0)) ** 2
    size = np.where(known, np.abs(found.lines.H), 0) ** 2
    omega, ratios = found.lines.s.imag, []
    for r in picked:
        pole = found.fit.model.poles[r]
        reach = max(-_SHARE * pole.real, 3 * np.diff(omega).mean())
        near = np.abs(omega - pole.imag) <= reach
        ratios.append(np.sqrt(error[near].sum() / size[near].sum()) if size[near].sum() else np.nan)
    return np.array(ratios)


def from_subspace(modes: list[UncertainMode], stable: np.ndarray) -> Modes:
    """Modes of outputs alone: no scale, covariance from the scatter of the record's blocks."""
    m = len(modes)
    poles = np.array([[mode.pole.real, mode.pole.imag] for mode in modes]).reshape(-1)
    scatter = np.concatenate([mode.scatter[:, :2] for mode in modes], axis=1) if m else np.zeros((1, 0))
    both = lambda x: (
        np.stack([frequency_and_damping(x[2 * r : 2 * r + 2]) for r in range(m)], axis=1).ravel() if m else x
    )
    value, covariance = propagated(both, poles, scatter.T @ scatter)
    parts = []
    for mode in modes:
        vector = np.concatenate([[mode.pole], mode.shape])
        at = np.stack([vector.real, vector.imag], axis=1).ravel()
        factor = _to_largest(turned(mode.shape))
        shaped = lambda x, factor=factor: factor * unit_length((x[0::2] + 1j * x[1::2])[1:])
        parts.append(_spread(shaped, at, mode.scatter.T @ mode.scatter, UNIT_LARGEST))
    return _modes(value, covariance, parts, stable, np.zeros(m), np.full(m, np.nan))


_STEP = 0.01  # of a standard deviation


def collinearity(shapes: np.ndarray) -> np.ndarray:
    """Modal phase collinearity (m,) of shapes (s, m): |sum psi^2|^2 / (sum |psi|^2)^2; 1 where all phases agree.

    R. S. Pappa, K. B. Elliott, A. Schenk, Journal of Guidance, Control and Dynamics 16 (1993) 860, without removal of the mean.

    >>> import numpy as np
    >>> collinearity(np.array([[1, 1], [2, 1j]])).tolist()
    [1.0, 0.0]
    """
    size = (np.abs(shapes) ** 2).sum(axis=0)
    return np.abs((shapes**2).sum(axis=0)) ** 2 / np.where(size > 0, size, 1.0) ** 2


def turned(shape: np.ndarray) -> np.ndarray:
    """A shape (s,) turned by the phase that makes its real part largest; its largest component is positive."""
    real = shape * np.exp(-0.5j * np.angle((shape**2).sum()))
    return real * (np.sign(real[np.abs(real).argmax()].real) or 1.0)


def unit_length(shape: np.ndarray) -> np.ndarray:
    """A shape (s,) turned, with the real part at unit length."""
    real = turned(shape)
    return real / np.linalg.norm(real.real)


def unit_mass(pole: complex, drive: complex, shape: np.ndarray, point: int) -> np.ndarray:
    """The shape at unit modal mass, from receptance residues psi l_j where output `point` is at input j of participation `drive`.

    R_dd = phi_d^2 / (2 i w_d), so phi = psi sqrt(2 i w_d l_j / psi_d) (D. J. Ewins, Modal Testing, 2000, section 2.4).
    """
    return turned(shape * np.sqrt(2j * pole.imag * drive / shape[point]))


def drive_angle(pole: complex, drive: complex, at_point: complex) -> float:
    """Angle, degrees, of phi_d^2 at a driving point: 0 for a real shape and a sensor that looks along the force."""
    return float(np.degrees(np.angle(2j * pole.imag * drive * at_point)))


def propagated(
    function: Callable[[np.ndarray], np.ndarray], at: np.ndarray, covariance: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """function(at) (q,) and its covariance (q, q) to first order, by central differences."""
    value = function(at)
    step = np.maximum(_STEP * np.sqrt(np.maximum(np.diag(covariance), 0)), 1e-8 * np.abs(at)) + 1e-300
    slope = np.empty((len(value), len(at)))
    for k, size in enumerate(step):
        move = np.zeros_like(at)
        move[k] = size
        slope[:, k] = (function(at + move) - function(at - move)) / (2 * size)
    return value, slope @ covariance @ slope.T
