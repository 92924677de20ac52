"""A structure that changed while it was recorded: a bolt that came loose, a part or a sensor that fell off, a support that settled.

No law of its motion explains that. The linear model explains what was recorded before by some values of its parameters, and what
was recorded after by others, at the same level.
"""

from collections.abc import Sequence
from copy import copy
from dataclasses import dataclass, replace

import numpy as np

from mouse_cli.updating.recordings.adequacy import INADEQUATE, close
from mouse_cli.updating.recordings.fit import Fit
from mouse_cli.updating.recordings.polish import followed
from mouse_cli.updating.recordings.segments import Segments
from mouse_cli.updating.recordings.series import passed
from mouse_cli.updating.recordings.study import Study, begin, fitted, spread_over

_FEWEST = 6  # stretches, of which the first third is fitted, or the last
_DURING = 2  # stretches in which it changes, at most
_LEVELS = 1.5  # ratio of the rms of both parts, up to which another stiffness is none of another level
_TOLD = 3  # parameters that moved most
# Prior sd that one of them moved, at least, as what drifts within its prior is none that changed at once; times the sd by which
# both parts know it
_APART, _SURELY = 2.0, 5.0


@dataclass(frozen=True)
class Changed:
    """last, first: recording and sample up to which the structure was as before, and from which it was as after; moved: nuisances
    with how many prior sd they moved, the furthest first.
    """

    last: tuple[str, int]
    first: tuple[str, int]
    moved: tuple[tuple[str, float], ...]

    def said(self) -> str:
        """What to do, in a sentence."""
        (before, last), (after, first) = self.last, self.first
        when = f"between samples {last} and {first} of '{before}'" if before == after else f"after '{before}', before '{after}'"
        moved = ", ".join(f"{name} {z:+.1f}" for name, z in self.moved)
        return (
            f"The structure changed {when}: the linear model explains what was recorded before and what was recorded after, each "
            f"by itself, and not both (prior sd from one to the other: {moved}). Look for what came loose then, and diagnose each "
            "part alone (segment, or hold_out)."
        )


def changed(own: Study) -> Changed | None:
    """When the structure changed; None where it did not, or once and for all cannot be said."""
    every = _stretches(own)
    return next((found for order in _orders(every) if (found := _once(own, every, order)) is not None), None)


def broken(own: Study) -> str:
    """What to do where the linear model explains all that was recorded before some moment, or after it, and nothing on the other
    side, at the same level; empty: it does not. A part of which no parameter tells may have fallen off.
    """
    every = _stretches(own)
    for order in _orders(every):
        first, alike, count = _begun(own, every, order)
        sound, rest = order[:count], order[count:]
        if first and len(rest) >= _DURING and not alike[list(rest)].any() and not _louder(own, sound, rest):
            return _breaking(own, every, sound, rest)
    return ""


def _breaking(own: Study, every, sound: Sequence[int], rest: Sequence[int]) -> str:
    before = min(sound) < min(rest)
    title, sample = _at(own, *every[(max if before else min)(sound)], end=before)
    part = f"Up to sample {sample} of '{title}'" if before else f"From sample {sample} of '{title}' on"
    return (
        f"{part} the linear model explains the records, and neither it nor any law that was tried explains what was recorded "
        f"{'after' if before else 'before'} that, at the same level: something changed then (a part fell off, a joint or a support "
        "came loose). Diagnose each part alone (segment, or hold_out)."
    )


def _stretches(own: Study) -> list[tuple[int, int]]:
    """Series and number of each stretch, in time; none where they are too few. Decays lose their level with time."""
    every = [(i, g) for i, part in enumerate(own.data) for g in range(len(part.starts))]
    return [] if len(every) < _FEWEST or own.look.free else every


def _orders(every: list[tuple[int, int]]) -> tuple[range, ...]:
    """Of the stretches, in time and back; none of none."""
    return (range(len(every)), range(len(every))[::-1]) if every else ()


def _begun(own: Study, every: list[tuple[int, int]], order: Sequence[int]) -> tuple[Fit | None, np.ndarray, int]:
    """The fit of the first third of the stretches in an order, None where the model does not explain them; the mask (G,) of those
    that it explains, and how many of these are the first in the order.
    """
    first = _explained(own, [every[k] for k in order[: len(every) // 3]])
    alike = np.zeros(len(every), dtype=bool) if first is None else _within(own, first)
    return first, alike, next((n for n, k in enumerate(order) if not alike[k]), len(order))


def _once(own: Study, every: list[tuple[int, int]], order: Sequence[int]) -> Changed | None:
    """The same, where the first third of the stretches in an order is before the change, or after it in an order back in time."""
    first, alike, count = _begun(own, every, order)
    if first is None:
        return None
    for skipped in range(_DURING + 1):
        rest = order[count + skipped :]
        second = _explained(own, [every[k] for k in rest]) if len(rest) and not alike[list(rest)].any() else None
        if second is not None and not _within(own, second)[list(order[:count])].any():
            return _told(own, every, (first, order[:count]), (second, rest))
    return None


def _told(own: Study, every, one: tuple[Fit, Sequence[int]], other: tuple[Fit, Sequence[int]]) -> Changed | None:
    """What changed from the earlier of two parts, each with its fit and the numbers of its stretches, to the later one."""
    (first, before), (last, after) = sorted((one, other), key=lambda part: min(part[1]))
    apart = last.x[: own.model.linear.k] - first.x[: own.model.linear.k]
    known = sum(np.abs(np.diag(each.covariance))[: len(apart)] for each in (first, last))
    far = (np.abs(apart) >= _APART) & (apart**2 >= _SURELY**2 * known)
    if not far.any() or _louder(own, before, after):
        return None
    names, order = first.hypothesis.names, np.argsort(-np.abs(apart))[:_TOLD]
    moved = tuple((names[i], float(apart[i])) for i in order if far[i])
    return Changed(_at(own, *every[max(before)], end=True), _at(own, *every[min(after)]), moved)


def _at(own: Study, i: int, g: int, end: bool = False) -> tuple[str, int]:
    part = own.data[i]
    return part.series.title, int(part.series.first + part.starts[g] + part.length * end)


def _explained(own: Study, some: list[tuple[int, int]]) -> Fit | None:
    """The linear model fitted to some stretches alone; None where it leaves more than noise of them."""
    alone = copy(own)
    starts = [[part.starts[g] for j, g in some if j == i] for i, part in enumerate(own.data)]
    alone.data = [replace(part, starts=np.array(at)) for part, at in zip(own.data, starts, strict=True) if at]
    found = fitted(alone, None)
    return found if found is not None and close(found) else None


def _within(own: Study, one: Fit) -> np.ndarray:
    """Mask (G,) of the stretches of which the model leaves no more than noise with its parameters as in a fit of others."""
    held, looks = one.hypothesis.held(one.x), own.looks(own.places[0])
    found = followed(held, own.data, spread_over(looks), np.zeros(0), *begin(held, one.x, own.data, looks))
    if found is None:
        return np.zeros(sum(len(part.starts) for part in own.data), dtype=bool)
    return (found.residual**2).mean(axis=(0, 1)) <= INADEQUATE * passed() * max(1.0, one.misfit / one.dof)


def _louder(own: Study, before: Sequence[int], after: Sequence[int]) -> bool:
    """Whether one of both parts is louder than the other."""
    rms = np.concatenate([_rms(part) for part in own.data])
    levels = [float(np.sqrt((rms[list(part)] ** 2).mean())) for part in (before, after)]
    return max(levels) > _LEVELS * min(levels)


def _rms(part: Segments) -> np.ndarray:
    return np.sqrt((part.measured**2).mean(axis=(0, 1)))
