"""Mass along rows of bars, in all directions in which they move, and beds under them, which feel what is across."""

from collections.abc import Callable

import numpy as np

from mouse_cli.diagnosis.sites.bars import Bars
from mouse_cli.diagnosis.sites.lines import Line
from mouse_cli.diagnosis.sites.stretches import covered
from mouse_cli.terms.elements import _beam as beam

Seen = Callable[[Bars, int, float], np.ndarray]  # of a bar, at a share of its length: the motion (., r) that counts


def deflections(bars: Bars, bar: int, at: float) -> np.ndarray:
    """Deflection (1, r) in the plane of a bar."""
    return bars.deflection(bar, at)[None]


def across(bars: Bars, bar: int, at: float) -> np.ndarray:
    """Deflections (planes, r) in all planes in which the element of a bar bends."""
    return np.array([bars.deflection(twin, at) for twin in bars.twins[int(bars.set[bar]), int(bars.member[bar])]])


def uniform(
    bars: Bars, elements: np.ndarray, a: np.ndarray, b: np.ndarray, mass: np.ndarray, seen: Seen = Bars.motion
) -> np.ndarray:
    """Matrix (r, r) of `mass` (c,) per length between the shares a and b (c,) of the length of `elements` (bars, one plane)."""
    rows, weights = [], []
    for i, first, last, m in zip(elements.tolist(), a, b, mass, strict=True):
        for point, weight in zip(beam.POINTS, beam.WEIGHTS, strict=True):
            rows.append(seen(bars, i, first + (last - first) * point))
            weights.append(np.full(len(rows[-1]), weight * m * (last - first) * bars.length[i]))
    if not rows:
        return np.zeros((bars.ends.shape[2],) * 2)
    u, w = np.concatenate(rows), np.concatenate(weights)
    return u.T @ (w[:, None] * u)


class Wet:
    """One unit per length, of mass or of what else feels the motion `seen`, on a row of bars, from its beginning to any place s."""

    def __init__(self, run: Line, seen: Seen = Bars.motion):
        self.run, self.seen, bars = run, seen, run.bars
        one = [uniform(bars, np.array([i]), np.zeros(1), np.ones(1), np.ones(1), seen) for i in run.members]
        self.sums = np.cumsum(one, axis=0)

    def upto(self, s: float) -> np.ndarray:
        """M (r, r) of the part before s."""
        touched, a, b = covered(self.run, 0.0, s)
        whole = int((b >= 1).sum())
        M = self.sums[whole - 1] if whole else np.zeros(self.sums.shape[1:])
        left = np.arange(whole, len(touched))
        return M + uniform(self.run.bars, touched[left], a[left], b[left], np.ones(len(left)), self.seen)

    def part(self, s: float, back: bool) -> np.ndarray:
        """Matrix (r, r) of the part before s, or (`back`) behind it."""
        return self.sums[-1] - self.upto(s) if back else self.upto(s)

    def between(self, first: float, last: float) -> np.ndarray:
        """Matrix (r, r) of the part between two places."""
        return self.upto(last) - self.upto(first)
