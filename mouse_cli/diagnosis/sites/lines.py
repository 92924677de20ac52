"""Bars that continue one another: places along them are distances from the beginning of the line."""

from bisect import bisect_right
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from mouse_cli.model.diagnosis import Site

ABOUT = "local z", "local y"  # the axis about which a bar bends in each plane
STRAIGHT = 0.999  # cosine of the angle between bars of one line


@dataclass(frozen=True)
class Line:
    """Bars `members` (c,) of `bars` that continue one another: a place is a distance s from its beginning."""

    bars: Any
    members: np.ndarray

    @cached_property
    def length(self) -> float:
        """Length in m."""
        return float(self.bars.length[self.members].sum())

    def at(self, s: float) -> tuple[int, float]:
        """The bar, and the share of its length, at the distance s."""
        bars, first, lengths = self._listed
        i = max(bisect_right(first, s) - 1, 0)
        return bars[i], min(max((float(s) - first[i]) / lengths[i], 0.0), 1.0)

    @cached_property
    def _listed(self) -> tuple[list[int], list[float], list[float]]:
        """Bars, distances at which they begin, and their lengths."""
        return tuple(each.tolist() for each in (self.members, self.start, self.extent))

    @cached_property
    def start(self) -> np.ndarray:
        """Distances (c,) at which the bars begin."""
        return self.bars.before[self.members]

    @cached_property
    def extent(self) -> np.ndarray:
        """Lengths (c,) of the bars."""
        return self.bars.length[self.members]

    @cached_property
    def both_ways(self) -> bool:
        """Whether all of its bars bend in two planes."""
        element = zip(self.bars.set[self.members].tolist(), self.bars.member[self.members].tolist(), strict=True)
        return all(len(self.bars.twins[each]) == 2 for each in element)

    @property
    def about(self) -> str:
        """The axis about which it bends, where it bends in two planes; else nothing."""
        return f"about {ABOUT[self.bars.plane[self.members[0]]]}" if self.both_ways else ""

    def parted(self, nodes: set[int]) -> list["Line"]:
        """Its parts between `nodes` (indices) that it passes."""
        cut = [i for i, bar in enumerate(self.members) if i and int(self.bars.nodes[bar, 0]) in nodes]
        return [Line(self.bars, part) for part in np.split(self.members, cut)]

    @property
    def inner(self) -> np.ndarray:
        """Distances (c - 1,) at which one bar ends and the next begins: a place is in one of them, and jumps there."""
        return self.bars.before[self.members[1:]]

    def site(self, s: float) -> Site:
        """The place at s."""
        return self.bars.site(*self.at(s))

    def starts(self, most: int, share: float) -> np.ndarray:
        """Places to begin a search from: at most one a bar and `most`, fewer where this is but a `share` of all lines.

        All are middles of bars: at an end the place has no slope, as a hinge there belongs to either bar.
        """
        count = max(1, min(most, len(self.members), round(2 * most * share)))
        first, length = self.bars.before[self.members], self.bars.length[self.members]
        at = np.searchsorted(first, (np.arange(count) + 0.5) / count * self.length, side="right") - 1
        return first[at] + 0.5 * length[at]

    @cached_property
    def middles(self) -> np.ndarray:
        """Motion (c, 3, r) of the middles of the bars."""
        return np.array([self.bars.motion(int(bar), 0.5) for bar in self.members])

    @property
    def ends(self) -> tuple[np.ndarray, np.ndarray]:
        """Coordinates (3,) of both ends."""
        last = self.members[-1]
        return self.bars.start[self.members[0]], np.array(self.bars.point(int(last), 1.0))


def joined_lines(part: dict[str, np.ndarray]) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """line, before (b,) and the order of bars in which those of a line follow one another."""
    b = len(part["length"])
    first: dict[tuple, list[int]] = {}
    for i in range(b):
        first.setdefault((int(part["nodes"][i, 0]), int(part["plane"][i])), []).append(i)
    into = np.full(b, -1)
    follows = np.full(b, -1)
    for i in range(b):
        here = (int(part["nodes"][i, 1]), int(part["plane"][i]))
        for j in first.get(here, ()):
            straight = part["axis"][i] @ part["axis"][j] > STRAIGHT and part["across"][i] @ part["across"][j] > STRAIGHT
            if j != i and straight and into[j] < 0 and follows[i] < 0:
                follows[i], into[j] = j, i
    line, before, order, number, done = [], [], [], 0, np.zeros(b, bool)
    for i in np.flatnonzero(into < 0).tolist() + list(range(b)):
        s, any_new = 0.0, not done[i]
        while i >= 0 and not done[i]:
            done[i] = True
            order.append(i), line.append(number), before.append(s)
            s, i = s + part["length"][i], int(follows[i])
        number += any_new
    return np.array(line, int), np.array(before), np.array(order, int)


def whole(line: Line) -> np.ndarray:
    """The bars of a line in every plane that they bend in."""
    bars = line.bars
    own = [bars.twins[int(bars.set[i]), int(bars.member[i])] for i in line.members]
    return np.array([i for twins in own for i in twins], int)


def elements(ids: tuple[int, ...]) -> str:
    """Elements in words: `element 3`, `elements 1 to 30`."""
    numbers = sorted(ids)
    if len(numbers) == 1:
        return f"element {numbers[0]}"
    if numbers[-1] - numbers[0] == len(numbers) - 1:
        return f"elements {numbers[0]} to {numbers[-1]}"
    return f"elements {', '.join(map(str, numbers[:4]))}{', ...' if len(numbers) > 4 else ''}"
