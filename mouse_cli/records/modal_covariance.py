"""Covariance of fitted poles, participations and shapes for errors of H that may be correlated between lines and channels.

To first order the unknowns are linear in the weighted errors e: d theta = C sum_o (P_o G_o)' e_o and
d psi_o = A_o^+ (e_o - G_o d theta), with C = (sum_o G_o' P_o G_o)^-1. For independent errors the covariance of theta is C. Windows
correlate neighbouring lines and noise of the force correlates outputs; then E e e^H is taken as separable, rho(line distance) times
a matrix of channels, both from the errors left by the fit, and goes through the same linear map (the `sandwich`: H. White,
Econometrica 48 (1980) 817). Where the errors that matter to one mode are larger than that, its covariance is raised (`excess`).
"""

from dataclasses import dataclass

import numpy as np

from mouse_cli.records.maximum_likelihood import free_participations, per_output
from mouse_cli.records.modal_model import Lines, ModalModel, complexed, synthesised

_REACH = 0.05  # of the lines, over which errors may be correlated
_FEW = 5  # distances from which on the correlation is tapered, so that its spectrum stays positive
_SIGNIFICANT = 4.0  # standard errors
_REACHED = 4  # lines on either side over which errors that matter to a mode are added up
_CHANCE = 3.0  # sd of a mean square from which on it is no chance
_LARGEST = 5_000_000  # values of the influence functions that are kept at once for correlated channels


@dataclass(frozen=True)
class Correlation:
    """rho (1 + reach,): of errors by distance in lines, rho_0 = 1; channels (o i, o i), None where they are independent."""

    rho: np.ndarray
    channels: np.ndarray | None = None

    @property
    def loudest(self) -> float:
        """Variance of the loudest combination of lines and channels over that of independent errors: largest eigenvalues."""
        along = np.fft.rfft(np.concatenate([self.tapered, self.tapered[:0:-1]])).real.max()
        return float(along * (1.0 if self.channels is None else np.linalg.eigvalsh(self.channels)[-1]))

    @property
    def tapered(self) -> np.ndarray:
        """rho, tapered where it is long, so that its spectrum stays positive."""
        return self.rho * (1 - np.arange(len(self.rho)) / len(self.rho) if len(self.rho) > _FEW else 1)


INDEPENDENT = Correlation(np.ones(1))


def correlation(lines: Lines, model: ModalModel) -> Correlation:
    """Correlation of the errors that the fit leaves, as far as it is significant."""
    known = np.isfinite(lines.sd)
    errors = np.where(known, (lines.H - synthesised(lines, model)) / np.where(known, lines.sd, 1.0), 0)
    errors = errors.reshape(len(lines.s), -1)
    power = (np.abs(errors) ** 2).sum()
    if not power:
        return INDEPENDENT
    reach = max(4, int(_REACH * len(errors)))
    lags = np.array(
        [(errors[lag:] * errors[: len(errors) - lag].conj()).sum().real / power for lag in range(reach + 1)]
    )
    noise = _SIGNIFICANT / np.sqrt(2 * known.sum())
    last = np.flatnonzero(np.append(np.abs(lags) <= noise, True))[0]
    return Correlation(lags[:last], _channels(errors))


def _channels(errors: np.ndarray) -> np.ndarray | None:
    """Correlation of channels (c, c), None where it is not significant as a whole."""
    lines, c = errors.shape
    norm = np.sqrt((np.abs(errors) ** 2).sum(axis=0))
    if c == 1 or not norm.all():
        return None
    found = (errors / norm).T @ (errors / norm).conj()
    shared = (np.abs(found) ** 2).sum() - c
    expected, scatter = c * (c - 1) / lines, np.sqrt(c * (c - 1) * 2) / lines
    return found if shared > expected + _SIGNIFICANT * scatter else None


@dataclass(frozen=True)
class ModalCovariance:
    """poles (2 m, 2 m): of real and imaginary parts by turns. modes: for each mode the covariance of its pole (2), its free
    participations (2 (i - 1)) and its shape (2 o), real and imaginary parts by turns. excess (m,): by what
    variances were raised."""

    poles: np.ndarray
    modes: tuple[np.ndarray, ...]
    excess: np.ndarray


def covariance(lines: Lines, model: ModalModel, errors: Correlation = INDEPENDENT) -> ModalCovariance:
    """Covariance at the fitted `model`."""
    if not model.m:
        return ModalCovariance(np.zeros((0, 0)), (), np.zeros(0))
    f, _, i = lines.H.shape
    both = [(found.off(slope), complexed(found.remainder, f, i)) for found, slope in per_output(lines, model)]
    inverse = np.linalg.pinv(sum(part.T @ part for part, _ in both), hermitian=True)
    influence = [complexed(inverse @ part.T, f, i) for part, _ in both]
    spread = _spread(influence, errors)
    theta = sum(_inner(a, b) for a, b in zip(influence, spread, strict=True))
    own, coupling, mixed = _outputs(lines, model, spread, errors)
    over = excess(
        [part[: 2 * model.m] for part in influence], [left for _, left in both], np.diag(theta)[: 2 * model.m]
    )
    modes = tuple(_mode(model, r, theta, own, coupling, mixed) * over[r] for r in range(model.m))
    raised = np.sqrt(np.repeat(over, 2))
    return ModalCovariance(theta[: 2 * model.m, : 2 * model.m] * np.outer(raised, raised), modes, over)


def excess(influence: list[np.ndarray], left: list[np.ndarray], variance: np.ndarray) -> np.ndarray:
    """By how much (m,) the variance of each mode is too small for the errors that the fit leaves where it matters to the mode.

    influence: of weighted errors on real and imaginary parts of the poles, (2 m, f, i) of each output; left (f, i): those errors;
    variance (2 m,): stated. A model that is not quite right (leakage, a frequency that changes with force, two tests that differ)
    errs at resonances, on few lines, where means over the band do not see it. The larger of two mean squares counts, where it
    is above 1 by more than chance makes it: of errors over their sd, weighted by their influence; and of the scores d = Re conj
    (influence) error over what they should have, summed over channels and over neighbouring lines with Bartlett's weights
    (W. K. Newey, K. D. West, Econometrica 55 (1987) 703).
    """
    size = np.stack([np.abs(part) ** 2 for part in influence], axis=2)
    power = np.stack([np.abs(part) ** 2 / 2 for part in left], axis=1)
    total = size.sum(axis=(1, 2, 3))
    near = np.einsum("tfoi,foi->t", size, power) / total
    scores = sum((part.conj() * error).real.sum(axis=2) for part, error in zip(influence, left, strict=True))
    summed = (scores**2).sum(axis=1)
    for lag in range(1, min(_REACHED, scores.shape[1] - 1) + 1):
        summed += 2 * (1 - lag / (_REACHED + 1)) * (scores[:, lag:] * scores[:, :-lag]).sum(axis=1)
    lines = size.sum(axis=(2, 3))
    free = 2 * total**2 / (size**2).sum(axis=(1, 2, 3)), total**2 / (lines**2).sum(axis=1)
    above = [
        np.where(ratio > 1 + _CHANCE * np.sqrt(2 / count), ratio, 1.0)
        for ratio, count in zip((near, summed / variance), free, strict=True)
    ]
    return np.max(above, axis=0).reshape(-1, 2).max(axis=1)


def _inner(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Re sum conj(a) b over lines and inputs: (t, f, i) and (u, f, i) to (t, u)."""
    return (a.reshape(len(a), -1).conj() @ b.reshape(len(b), -1).T).real


def _along(values: np.ndarray, errors: Correlation) -> np.ndarray:
    """The correlation of lines applied to (..., f, i)."""
    rho = errors.tapered
    if len(rho) == 1:
        return values
    lines = values.shape[-2]
    size = lines + 2 * len(rho)
    kernel = np.zeros(size)
    kernel[: len(rho)] = rho
    kernel[-len(rho) + 1 :] = kernel[1 : len(rho)][::-1]
    spectrum = np.fft.fft(kernel)[:, None]
    return np.fft.ifft(np.fft.fft(values, size, axis=-2) * spectrum, axis=-2)[..., :lines, :]


def _spread(influence: list[np.ndarray], errors: Correlation) -> list[np.ndarray]:
    """E e e^H applied to the influence functions of each output."""
    along = [_along(part, errors) for part in influence]
    size = sum(part.size for part in influence)
    if errors.channels is None or size > _LARGEST:
        return along
    mixed = np.einsum("dc,tfc->tfd", errors.channels, np.concatenate(along, axis=2))
    return np.split(mixed, len(influence), axis=2)


def _outputs(
    lines: Lines, model: ModalModel, spread: list[np.ndarray], errors: Correlation
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """For each output: covariance (2 m, 2 m) of its shape components from its own errors; their slopes (2 m, t) to theta; and their
    covariance (t, 2 m) with theta."""
    f, _, i = lines.H.shape
    own, slopes, mixed = [], [], []
    for o, (found, slope) in enumerate(per_output(lines, model)):
        rows = found.inverse(2 * model.m)
        kernel = complexed(rows, f, i)
        seen = _along(kernel, errors)
        if errors.channels is not None:
            block = errors.channels[o * i : (o + 1) * i, o * i : (o + 1) * i]
            seen = seen @ block.T
        own.append(_inner(kernel, seen))
        slopes.append(rows @ slope)
        mixed.append(_inner(spread[o], kernel))
    return np.array(own), np.array(slopes), np.array(mixed)


def _mode(
    model: ModalModel, r: int, theta: np.ndarray, own: np.ndarray, slopes: np.ndarray, mixed: np.ndarray
) -> np.ndarray:
    """Covariance of one mode's pole, free participations and shape."""
    _, columns = free_participations(model.participation)
    places = [2 * r, 2 * r + 1]
    for k in np.flatnonzero(columns == r):
        places += [2 * (model.m + k), 2 * (model.m + k) + 1]
    rows = [r, model.m + r]
    D, M = slopes[:, rows], mixed[:, :, rows]
    outputs, t = len(own), len(places)
    flat = D.reshape(2 * outputs, -1)
    back = M.transpose(0, 2, 1).reshape(2 * outputs, -1)  # (2 o, t): shape errors of their own with theta
    shape = flat @ theta @ flat.T - flat @ back.T - back @ flat.T
    for o in range(outputs):
        shape[2 * o : 2 * o + 2, 2 * o : 2 * o + 2] += own[o][np.ix_(rows, rows)]
    cross = back[:, places] - flat @ theta[:, places]
    whole = np.empty((t + 2 * outputs,) * 2)
    whole[:t, :t], whole[t:, t:] = theta[np.ix_(places, places)], shape
    whole[t:, :t], whole[:t, t:] = cross, cross.T
    return whole
