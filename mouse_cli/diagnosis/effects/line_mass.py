"""Mass along rows of bars, in all directions in which they move, and beds under them, which feel what is across."""

from collections.abc import Callable
from functools import cached_property

import numpy as np

from mouse_cli.diagnosis.sites.bars import Bars
from mouse_cli.diagnosis.sites.lines import Line

Seen = Callable[[Bars, int], np.ndarray]  # of a bar: what counts (c, 4, r), by powers of the share of its length
_POWERS = np.add.outer(np.arange(4), np.arange(4)) + 1  # of the share, in integrals of products of two powers


def deflections(bars: Bars, bar: int) -> np.ndarray:
    """Deflection in the plane of a bar, (1, 4, r)."""
    return bars.cubic[[bar]]


def across(bars: Bars, bar: int) -> np.ndarray:
    """Deflections (planes, 4, r) in all planes in which the element of a bar bends."""
    return bars.cubic[bars.twins[int(bars.set[bar]), int(bars.member[bar])]]


def motions(bars: Bars, bar: int) -> np.ndarray:
    """Displacements (1 + planes, 4, r) along the element of a bar, and across it."""
    along = np.zeros_like(bars.cubic[[bar]])
    along[0, :2] = bars.axial[bar, 0], bars.axial[bar, 1] - bars.axial[bar, 0]
    return np.concatenate([along, across(bars, bar)])


def uniform(bars: Bars, bar: int, share: float = 1.0, seen: Seen = motions) -> np.ndarray:
    """Matrix (r, r) of one unit per length on the first `share` of the length of a bar."""
    u = seen(bars, bar)
    weighed = (bars.length[bar] * share**_POWERS / _POWERS) @ u
    return u.reshape(-1, u.shape[2]).T @ weighed.reshape(-1, u.shape[2])


class LineIntegral:
    """One unit per length, of mass or of what else feels the motion `seen`, on a row of bars, from its beginning to any place s."""

    def __init__(self, run: Line, seen: Seen = motions):
        self.run, self.seen = run, seen
        self._number = {bar: i for i, bar in enumerate(run.members.tolist())}

    @cached_property
    def sums(self) -> np.ndarray:
        """Matrices (b, r, r) of the bars up to each of them."""
        return np.cumsum([uniform(self.run.bars, bar, seen=self.seen) for bar in self.run.members.tolist()], axis=0)

    def upto(self, s: float) -> np.ndarray:
        """M (r, r) of the part before s."""
        bar, share = self.run.at(s)
        begun, i = uniform(self.run.bars, bar, share, self.seen), self._number[bar]
        return begun + self.sums[i - 1] if i else begun

    def part(self, s: float, back: bool) -> np.ndarray:
        """Matrix (r, r) of the part before s, or (`back`) behind it."""
        return self.sums[-1] - self.upto(s) if back else self.upto(s)

    def between(self, first: float, last: float) -> np.ndarray:
        """Matrix (r, r) of the part between two places."""
        return self.upto(last) - self.upto(first)
