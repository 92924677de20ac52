"""How accurate a channel of a record is: its noise, its resolution, and the share of a motion that no theory meets.

A mass that nothing holds keeps its place and speed whatever the theory: only what forces make of a stretch of a record, beside
the initial state that every fit of a stretch has free, is a measure of the theory.
"""

from dataclasses import replace

import numpy as np

from mouse_cli.updating.recordings.records import FLOOR, Records
from mouse_cli.updating.recordings.series import Series

_ROUNDING = 1e-12  # of the largest value: no step
_FEWEST, _NEAR = 8, 20.0  # gaps between values that show a resolution; the largest of them, in steps
_UNEVEN = 0.05  # of a step, by which multiples of it may miss in a file: chance makes one of ten gaps so even


def accurate(found: Records, length: int, slow: int) -> Records:
    """The records with the accuracy that stretches of `length` samples have; slow: see `Series`.

    Of a structure that something holds the zeros of channels are free: accelerations and velocities have no mean, and nobody
    knows what an amplifier or a gauge reads at rest. What nothing holds has means of its own, and its initial states.
    """
    steps = np.max([[resolution(x) for x in one.measured.T] for one in found.fitted], axis=0) / np.sqrt(12)
    sd = np.maximum(found.fitted[0].sd, steps)
    if slow:
        noise = np.max([one.sd if one.floor is None else one.floor for one in found.fitted], axis=0)
        sd = np.max([noise, steps, FLOOR * np.max([forced(one, length) for one in found.fitted], axis=0)], axis=0)
    wider = lambda one: None if one.floor is None else np.maximum(one.floor, steps)
    free = lambda one: replace(one.disturbance, offset=not slow)
    with_sd = lambda many: tuple(
        replace(one, sd=sd, floor=wider(one), slow=min(slow, len(one) // 6), disturbance=free(one)) for one in many
    )
    return replace(found, fitted=with_sd(found.fitted), held=with_sd(found.held))


def forced(series: Series, length: int) -> np.ndarray:
    """rms (s,) of channels about the motion without force of a free mass, stretch by stretch: a place and a speed.

    Displacements are taken about straight lines, velocities about means, accelerations as they are.
    """
    count = max(len(series) // length, 1)
    t = np.linspace(-1.0, 1.0, len(series) // count)
    found = []
    for x, order in zip(series.measured.T, series.order, strict=True):
        parts = x[: count * len(t)].reshape(count, len(t))
        free = np.stack([t**i for i in range(2 - order)], axis=1) if order < 2 else np.zeros((len(t), 0))
        Q = np.linalg.qr(free)[0]
        found.append(np.sqrt(((parts - parts @ Q @ Q.T) ** 2).mean()))
    return np.array(found)


def resolution(x: np.ndarray) -> float:
    """The step of which all values of a channel (t,) are multiples; 0 where there is none.

    Gaps between its values are multiples of it, all of those that are small; gaps of continuous values are of any size.
    """
    values = np.unique(x)
    apart = np.diff(values)
    apart = apart[apart > _ROUNDING * np.abs(values).max(initial=0.0)]
    near = apart[apart < _NEAR * apart.min(initial=np.inf)]
    if len(near) < _FEWEST:
        return 0.0
    step = float(np.mean(near[near < 1.5 * near.min()]))
    return step if np.abs(near / step - np.round(near / step)).max() < _UNEVEN else 0.0
