"""How uncertain the lines of frequency response functions are, where nobody said so or where a fit shows it.

A fit leaves errors e. Their variance is taken as a^2 + b^2 |H|^2 in each channel (noise of the sensor, and of what scales with the
response), times its ratio to |e|^2 averaged over lines, so that slow changes along the band are followed.
"""

from dataclasses import replace

import numpy as np

from mouse_cli.records.modal_model import Lines, ModalModel, synthesised

_WINDOW = 41  # lines
_FLOOR = 1e-7  # sd over the root mean square of a channel: exact data have errors too


def without_sd(s: np.ndarray, H: np.ndarray, kind: int) -> Lines:
    """Lines whose sd are a share of the level around them, for a first fit: no mode is drowned by a stronger one elsewhere."""
    known = np.isfinite(H)
    H = np.where(known, H, 0)
    level = np.sqrt(averaged(np.abs(H) ** 2, known))
    sd = np.where(known & (level > 0), 0.01 * np.where(level > 0, level, 1.0), np.inf)
    return Lines(s, H, sd, kind)


def with_sd(s: np.ndarray, H: np.ndarray, variance: np.ndarray, kind: int) -> Lines:
    """Lines with the variance that was measured; none below the rounding of the data."""
    known = np.isfinite(H) & np.isfinite(variance)
    H = np.where(known, H, 0)
    level = np.sqrt((np.abs(H) ** 2).mean(axis=0))
    sd = np.where(known & (level > 0), np.maximum(np.sqrt(np.where(known, variance, 1.0)), _FLOOR * level), np.inf)
    return Lines(s, H, sd, kind)


def measured_noise(lines: Lines, model: ModalModel) -> Lines:
    """The lines with sd from the errors that the fit leaves."""
    fitted = synthesised(lines, model)
    known = np.isfinite(lines.sd)
    power = np.abs(np.where(known, lines.H - fitted, 0)) ** 2
    power *= (
        2 * known.sum() / max(2 * known.sum() - 2 * model.m * sum(model.residuals.shape[1:]) - model.residuals.size, 1)
    )
    return replace(lines, sd=np.where(known, np.sqrt(smoothed(power, fitted, known)), np.inf))


def smoothed(power: np.ndarray, H: np.ndarray, known: np.ndarray) -> np.ndarray:
    """Variance (f, o, i) behind single squared errors `power`: a^2 + b^2 |H|^2 of each channel, times a ratio along the band."""
    size, expected = np.abs(H) ** 2, np.ones_like(power)
    for o in range(power.shape[1]):
        for i in range(power.shape[2]):
            expected[:, o, i] = _two_sources(power[:, o, i], size[:, o, i], known[:, o, i])
    least = _FLOOR**2 * np.where(known, size, 0).mean(axis=0)
    expected = np.maximum(expected, least)
    ratio = averaged(np.where(known, power / np.where(expected > 0, expected, 1.0), 0), known)
    return np.maximum(expected * ratio, least)


def _two_sources(power: np.ndarray, size: np.ndarray, known: np.ndarray) -> np.ndarray:
    """a^2 + b^2 |H|^2 nearest to |e|^2, each line weighted by what it is expected to have."""
    from scipy.optimize import nnls

    if not known.any() or not power[known].any():
        return np.zeros_like(power)
    columns = np.stack([np.ones_like(size), size], axis=1)
    expected = np.full_like(power, power[known].mean())
    for _ in range(4):
        w = known / expected
        found, _ = nnls(columns * w[:, None] * expected[known].mean(), power * w * expected[known].mean())
        expected = np.maximum(columns @ found, 1e-6 * power[known].mean())
    return expected


def averaged(values: np.ndarray, known: np.ndarray) -> np.ndarray:
    """Mean of known values over a window of lines, for each channel (f, o, i)."""
    reach = min(_WINDOW, len(values)) // 2
    padded = [
        np.concatenate([np.zeros((1, *a.shape[1:])), np.cumsum(a, axis=0)]) for a in (values, known.astype(float))
    ]
    first = np.maximum(np.arange(len(values)) - reach, 0)
    last = np.minimum(np.arange(len(values)) + reach + 1, len(values))
    total, count = (sums[last] - sums[first] for sums in padded)
    return total / np.maximum(count, 1)


def widened(lines: Lines, model: ModalModel) -> tuple[Lines, float]:
    """The lines with sd raised where the fit errs more than they say, and the share of the lines where it does.

    All channels together decide; a mean square that chance alone could make is left at 1.
    """
    known = np.isfinite(lines.sd)
    errors = np.abs(np.where(known, (lines.H - synthesised(lines, model)) / np.where(known, lines.sd, 1.0), 0)) ** 2
    pooled, count = errors.sum(axis=(1, 2))[:, None, None], known.sum(axis=(1, 2))[:, None, None].astype(float)
    window = max(min(_WINDOW, len(errors)), 1)
    ratio = averaged(pooled, np.ones_like(count, bool)) / np.maximum(averaged(count, np.ones_like(count, bool)), 1e-9)
    chance = 1 + 3 / np.sqrt(np.maximum(averaged(count, np.ones_like(count, bool)) * window, 1))
    factor = np.where(ratio > chance, ratio, 1.0)
    return replace(lines, sd=lines.sd * np.sqrt(factor)), float((factor > 1).mean())
