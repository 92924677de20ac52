"""Channels that are no measurement: gaps, clipped, dead and stuck ones, and time columns with samples missing."""

from dataclasses import dataclass

import numpy as np

_SHORTEST_TOP = 3  # equal samples at the extreme that are a flat top
_STUCK = 200  # equal samples in a row, not at zero, that are no vibration
_DROPPED, _SELDOM, _JUMP = 20, 0.1, 0.3  # zeros in a row; share of all samples; of the rms, of the samples before and after them
_EXTREME = 0.5  # of the largest magnitude: a flat value below is rest, no limit
_LIMITED = 0.5  # a signal that stands at its extremes for longer is a binary excitation


@dataclass(frozen=True)
class Fault:
    """kind: gap, dead, constant, clipped or stuck; sample: the first, from 0; count: of those affected; value: theirs."""

    kind: str
    sample: int
    count: int
    value: float = 0.0


def faults(x: np.ndarray) -> list[Fault]:
    """What is wrong with the samples x (t,) of a channel.

    clipped: at least two runs of three or more samples at the largest or the smallest value, into which the signal steps by more
    than its resolution; a peak that rounding makes flat is entered from one step of resolution below.
    """
    low, high = float(x.min()), float(x.max())
    if not np.isfinite(high - low):
        finite = np.isfinite(x)
        return [Fault("gap", int(np.argmin(finite)), int((~finite).sum()))]
    if low == high:
        return [Fault("constant" if low else "dead", 0, len(x), low)]
    found = [_clipped(x, value) for value in (low, high) if abs(value) >= _EXTREME * max(-low, high)]
    return [fault for fault in [*found, _stuck(x, low, high), _dropped(x)] if fault is not None]


def _clipped(x: np.ndarray, value: float) -> Fault | None:
    at = x == value
    if np.count_nonzero(at) < 2 * _SHORTEST_TOP:
        return None
    begin, length = _runs(at)
    begin, length = begin[length >= _SHORTEST_TOP], length[length >= _SHORTEST_TOP]
    if len(begin) < 2 or length.sum() > _LIMITED * len(x):
        return None
    beside = np.concatenate([x[begin[begin > 0] - 1], x[(begin + length)[begin + length < len(x)]]])
    levels = np.unique(x)
    steps = np.diff(levels)
    resolution = steps[steps > 1e-9 * (levels[-1] - levels[0])].min()
    if np.median(np.abs(beside - value)) <= 2.5 * resolution:
        return None
    return Fault("clipped", int(begin[0]), int(length.sum()), value)


def _stuck(x: np.ndarray, low: float, high: float) -> Fault | None:
    same = x[1:] == x[:-1]
    if np.count_nonzero(same) < _STUCK:
        return None
    begin, length = _runs(same)
    if not len(begin) or length.max() < _STUCK:
        return None
    keep = (length >= _STUCK) & (x[begin] != 0) & (x[begin] != low) & (x[begin] != high)
    if not keep.any():
        return None
    first = int(begin[keep][0])
    return Fault("stuck", first, int(length[keep].sum() + keep.sum()), float(x[first]))


def _dropped(x: np.ndarray) -> Fault | None:
    """Zeros in the midst of a motion, as of a loose cable: a force that acts now and then is zero for most of the time."""
    at = x == 0
    if not _DROPPED <= np.count_nonzero(at) <= _SELDOM * len(x):
        return None
    begin, length = _runs(at)
    least, end = _JUMP * float(np.sqrt((x**2).mean())), begin + length
    inside = (length >= _DROPPED) & (begin > 0) & (end < len(x))
    jumps = inside & (np.abs(x[begin - 1]) > least) & (np.abs(x[np.minimum(end, len(x) - 1)]) > least)
    return Fault("stuck", int(begin[jumps][0]), int(length[jumps].sum()), 0.0) if jumps.any() else None


def _runs(mask: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """First index and length of every run of True."""
    if not mask.any():
        return np.zeros(0, int), np.zeros(0, int)
    edges = np.flatnonzero(np.diff(np.concatenate([[False], mask, [False]]).astype(np.int8)))
    return edges[::2], edges[1::2] - edges[::2]


@dataclass(frozen=True)
class Clock:
    """What a time column says. step_s: mean time between samples where none is missing; resolution_s: of the column.

    breaks: (sample, missing) of each place, the number of the sample after it and of those that are missing; backward, still: the
    first sample that is earlier than the one before, or as late, None where there is none.
    """

    step_s: float
    resolution_s: float
    breaks: tuple[tuple[int, int], ...] = ()
    backward: int | None = None
    still: int | None = None


def clock(t: np.ndarray) -> Clock | None:
    """The even spacing behind the times t (k,) in s; None where there is none to be found."""
    if len(t) < 3 or not np.isfinite(t).all():
        return None
    steps = np.diff(t)
    if (steps < 0).any():
        return Clock(float("nan"), 0.0, backward=int(np.argmax(steps < 0)) + 1)
    if not t[-1] > t[0]:
        return None
    positive = steps[steps > 0]
    # rounded times step by 0 or by one unit of the last digit: then the mean is the step, and breaks are beyond several units
    rounded = len(positive) < 0.99 * len(steps)
    if len(positive) < len(steps) and not rounded:
        return Clock(float("nan"), 0.0, still=int(np.argmax(steps == 0)) + 1)
    step = float(t[-1] - t[0]) / len(steps) if rounded else float(np.median(steps))
    resolution = float(positive.min()) if rounded else float(np.median(np.abs(steps - step)))
    broken = np.flatnonzero(steps > 1.5 * step + 2 * resolution)
    even = np.delete(steps, broken)
    step = float(even.mean()) if len(even) and not rounded else step
    breaks = tuple((int(i) + 1, max(1, round(float(steps[i]) / step) - 1)) for i in broken)
    return Clock(step, resolution, breaks)
