"""Damped vibrations fitted to free decays by maximum likelihood, with the covariance of poles and shapes.

Without a force every channel of a linear structure is y(t) = b + sum_r Re(c_r exp(lambda_r t)), its initial state in the c_r alone.
They and b are linear and projected out (G. H. Golub, V. Pereyra, SIAM J. Numer. Anal. 10 (1973) 413; the derivative without its
small part: L. Kaufman, BIT 15 (1975) 49). What the fit leaves need not be white: its spectrum goes through the linear maps.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from mouse_cli.records.ssi import UncertainMode

_ROUNDS = 3  # of the noise of the channels, which weighs them
_SMOOTH = 16, 0.02  # lines over which the spectrum of what is left is averaged: at least, and by their number
_SEEN = 0.1  # share of the noise of lines that a fit leaves, at least
_TINY = 1e-9  # of a channel: its least noise, that of rounding


@dataclass(frozen=True)
class Decays:
    """poles (m,) rad/s; of records coefficients (2m + 1, o) of cos, sin, ..., 1, and left (t, o): what remains, over sd (o,)."""

    records: tuple[np.ndarray, ...]
    rate_hz: float
    poles: np.ndarray
    coefficients: tuple[np.ndarray, ...]
    left: tuple[np.ndarray, ...]
    sd: tuple[np.ndarray, ...]

    @property
    def chi2(self) -> float:
        """Of all records together."""
        return float(sum((each**2).sum() for each in self.left))


def basis(poles: np.ndarray, count: int, rate_hz: float) -> np.ndarray:
    """exp(sigma t) cos(omega t), exp(sigma t) sin(omega t) of each pole and 1 (count, 2m + 1)."""
    wave = np.exp(np.outer(np.arange(count) / rate_hz, poles))
    return np.column_stack([np.stack([wave.real, wave.imag], axis=2).reshape(count, -1), np.ones(count)])


def fitted(records: Sequence[np.ndarray], rate_hz: float, poles: np.ndarray, before: Decays | None = None) -> Decays:
    """Poles that serve all records (t, o) best, from `poles` (m,) on; noise of the channels as in `before`, else found."""
    sd = None if before is None else before.sd
    for _ in range(_ROUNDS if before is None else 1):
        poles = _followed(records, rate_hz, poles, sd) if len(poles) else poles
        left, coefficients = zip(*(_left(each, rate_hz, poles) for each in records), strict=True)
        if before is None:
            sd = tuple(_sd(each, rest, len(poles)) for each, rest in zip(records, left, strict=True))
    return Decays(
        tuple(records), rate_hz, poles, coefficients, tuple(one / own for one, own in zip(left, sd, strict=True)), sd
    )


def _sd(record: np.ndarray, left: np.ndarray, m: int) -> np.ndarray:
    free = max(len(record) - 2 * m - 1, 1)
    return np.maximum(np.sqrt((left**2).sum(axis=0) / free), _TINY * np.abs(record).max(axis=0) + np.finfo(float).tiny)


def _left(record: np.ndarray, rate_hz: float, poles: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """What the best coefficients leave (t, o), and they (2m + 1, o)."""
    A = basis(poles, len(record), rate_hz)
    coefficients = np.linalg.lstsq(A, record, rcond=None)[0]
    return record - A @ coefficients, coefficients


def slopes(poles: np.ndarray, coefficients: np.ndarray, count: int, rate_hz: float) -> np.ndarray:
    """Derivatives (2m, t, o) of the motion by the real and the imaginary part of each pole, coefficients held."""
    t = np.arange(count)[:, None] / rate_hz
    pairs = coefficients[:-1].reshape(len(poles), 2, coefficients.shape[1])
    found = []
    for pole, (a, b) in zip(poles, pairs, strict=True):
        moved = t * np.exp(pole * t) * (a - 1j * b)
        found += [moved.real, -moved.imag]
    return np.array(found).reshape(2 * len(poles), count, coefficients.shape[1])


def _parts(found: Decays) -> list[tuple]:
    """Coefficients, noise, length and rate of each record."""
    pairs = zip(found.coefficients, found.sd, found.records, strict=True)
    return [(coefficients, sd, len(record), found.rate_hz) for coefficients, sd, record in pairs]


def _projected(coefficients: np.ndarray, sd: np.ndarray, count: int, rate_hz: float, poles: np.ndarray) -> np.ndarray:
    """The same over sd (o,), without what the coefficients take up (2m, t, o)."""
    Q = np.linalg.qr(basis(poles, count, rate_hz))[0]
    found = slopes(poles, coefficients / sd, count, rate_hz)
    return found - np.einsum("tk,jko->jto", Q, np.einsum("tk,jto->jko", Q, found))


def _followed(
    records: Sequence[np.ndarray], rate_hz: float, poles: np.ndarray, sd: tuple[np.ndarray, ...] | None
) -> np.ndarray:
    """Least squares over the poles, each in units of its decay rate and of its circular frequency."""
    from scipy.optimize import least_squares

    unit = np.repeat(-poles.real, 2)
    weight = [np.ones(1)] * len(records) if sd is None else [1 / own for own in sd]
    pole = lambda x: (x * unit).reshape(-1, 2) @ np.array([1.0, 1j])

    def residual(x: np.ndarray) -> np.ndarray:
        parts = [(_left(each, rate_hz, pole(x))[0] * own).ravel() for each, own in zip(records, weight, strict=True)]
        return np.concatenate(parts)

    def jacobian(x: np.ndarray) -> np.ndarray:
        parts = []
        for each, own in zip(records, weight, strict=True):
            found = _projected(_left(each, rate_hz, pole(x))[1], 1 / own, len(each), rate_hz, pole(x))
            parts.append(-found.reshape(len(x), -1).T)
        return np.concatenate(parts) * unit

    turns = np.arange(len(unit)) % 2 == 1
    bounds = np.where(turns, 0.0, -np.inf), np.where(turns, np.pi * rate_hz / unit, -1e-6)
    start = np.clip(np.stack([poles.real, poles.imag], axis=1).ravel() / unit, *bounds)
    return pole(least_squares(residual, start, jacobian, bounds=bounds, xtol=1e-10, ftol=1e-10).x)


def level(found: Decays) -> list[np.ndarray]:
    """Spectra (l, o) of the noise of each record, over sd: 1 where it is white; averaged over neighbouring lines.

    What is left of white noise e is P e, P = 1 - Q Q' of all that was fitted, and has the power 1 - |Q|^2 at a line: less at modes.
    """
    from scipy.ndimage import uniform_filter1d

    J = [_projected(*each, found.poles) for each in _parts(found)]
    whole = np.concatenate([each.reshape(2 * len(found.poles), -1) for each in J], axis=1)
    ends = np.cumsum([each.size for each in found.left])[:-1]
    rows = np.split(np.linalg.qr(whole.T)[0].T, ends, axis=1)
    spectra = []
    for left, flat in zip(found.left, rows, strict=True):
        power = lambda x: np.abs(np.fft.rfft(x, axis=-2)) ** 2 / len(left)  # noqa: B023
        Q = np.linalg.qr(basis(found.poles, len(left), found.rate_hz))[0]
        lost = power(Q).sum(axis=1, keepdims=True) + power(flat.reshape(-1, *left.shape)).sum(axis=0)
        mean = lambda x: uniform_filter1d(x, max(_SMOOTH[0], int(_SMOOTH[1] * len(x))), axis=0, mode="nearest")
        spectra.append(mean(power(left)) / np.maximum(mean(1 - lost), _SEEN))
    return spectra


def _through(columns: np.ndarray, spectrum: np.ndarray) -> np.ndarray:
    """Covariance (k, k) of columns' (t, k) products with noise of a spectrum (l,)."""
    lines = np.fft.rfft(columns, axis=0)
    twice = np.full(len(lines), 2.0)
    twice[0] = 1.0
    twice[-1] = 1.0 if len(columns) % 2 == 0 else 2.0
    return ((lines.conj() * (twice * spectrum)[:, None]).T @ lines).real / len(columns)


def uncertain(found: Decays) -> list[UncertainMode]:
    """The modes: the errors of all poles to first order, and of the shapes of each, by the spectrum of what the fit leaves."""
    m, spectra = len(found.poles), level(found)
    H, middle = np.zeros((2, 2 * m, 2 * m))
    for part, spectrum in zip(_parts(found), spectra, strict=True):
        J = _projected(*part, found.poles)
        for j in range(spectrum.shape[1]):
            H += J[:, :, j] @ J[:, :, j].T
            middle += _through(J[:, :, j].T, spectrum[:, j])
    back = np.linalg.inv(H)
    covariance = back @ middle @ back
    root = np.linalg.cholesky(covariance + 1e-14 * np.diag(np.diag(covariance))).T
    own = [_coefficients(found, i, spectra[i]) for i in range(len(found.records))]
    return [_mode(found, r, root, own) for r in range(m)]


def _coefficients(found: Decays, i: int, spectrum: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Of record i: how coefficients follow the poles (2m, 2m + 1, o), and their covariance by noise (o, 2m + 1, 2m + 1)."""
    record, sd = found.records[i], found.sd[i]
    A = basis(found.poles, len(record), found.rate_hz)
    inverse = np.linalg.pinv(A)
    moved = slopes(found.poles, found.coefficients[i], len(record), found.rate_hz)
    noise = [_through(inverse.T, spectrum[:, j]) * sd[j] ** 2 for j in range(len(sd))]
    return -np.einsum("kt,jto->jko", inverse, moved), np.array(noise)


def _mode(found: Decays, r: int, root: np.ndarray, own: list[tuple[np.ndarray, np.ndarray]]) -> UncertainMode:
    """Shape: residues of all records, each counted by how much it moves; rows of scatter: of all poles, then of each output."""
    part = slice(2 * r, 2 * r + 2)
    residue = np.stack([each[2 * r] - 1j * each[2 * r + 1] for each in found.coefficients], axis=1)
    share = np.linalg.svd(residue / found.sd[0][:, None], full_matrices=False)[2][0].conj()
    o = len(residue)
    moved, spread = np.zeros((len(root), o), complex), np.zeros((o, 2, 2))
    for one, (slope, noise) in zip(share, own, strict=True):
        moved += one * (slope[:, 2 * r] - 1j * slope[:, 2 * r + 1])
        turn = np.array([[one.real, one.imag], [one.imag, -one.real]])  # of one (a - i b)
        spread += turn @ noise[:, part, part] @ turn.T
    shape_errors = np.zeros((2 * o, o, 2))
    for j, each in enumerate(spread):
        shape_errors[2 * j : 2 * j + 2, j] = np.linalg.cholesky(each + 1e-14 * np.trace(each) * np.eye(2)).T
    carried = root @ moved
    scatter = np.zeros((len(root) + 2 * o, 2 + 2 * o))
    scatter[: len(root), :2] = root[:, part]
    scatter[: len(root), 2:] = np.stack([carried.real, carried.imag], axis=2).reshape(len(root), -1)
    scatter[len(root) :, 2:] = shape_errors.reshape(2 * o, -1)
    return UncertainMode(complex(found.poles[r]), residue @ share, scatter)
