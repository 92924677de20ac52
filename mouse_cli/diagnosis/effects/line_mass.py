"""Mass along rows of bars, in all directions in which they move."""

import numpy as np

from mouse_cli.diagnosis.sites.bars import Bars
from mouse_cli.diagnosis.sites.lines import Line
from mouse_cli.diagnosis.sites.stretches import covered
from mouse_cli.terms.elements import _beam as beam


def uniform(bars: Bars, elements: np.ndarray, a: np.ndarray, b: np.ndarray, mass: np.ndarray) -> np.ndarray:
    """Matrix (r, r) of `mass` (c,) per length between the shares a and b (c,) of the length of `elements` (bars, one plane)."""
    rows, weights = [], []
    for i, first, last, m in zip(elements.tolist(), a, b, mass, strict=True):
        for point, weight in zip(beam.POINTS, beam.WEIGHTS, strict=True):
            rows.append(bars.motion(i, first + (last - first) * point))
            weights.append(np.full(3, weight * m * (last - first) * bars.length[i]))
    if not rows:
        return np.zeros((bars.ends.shape[2],) * 2)
    u, w = np.concatenate(rows), np.concatenate(weights)
    return u.T @ (w[:, None] * u)


class Wet:
    """Mass of one unit per length on a row of bars, from its beginning to any place s."""

    def __init__(self, run: Line):
        self.run, bars = run, run.bars
        one = [uniform(bars, np.array([i]), np.zeros(1), np.ones(1), np.ones(1)) for i in run.members]
        self.sums = np.cumsum(one, axis=0)

    def upto(self, s: float) -> np.ndarray:
        """M (r, r) of the part before s."""
        touched, a, b = covered(self.run, 0.0, s)
        whole = int((b >= 1).sum())
        M = self.sums[whole - 1] if whole else np.zeros(self.sums.shape[1:])
        left = np.arange(whole, len(touched))
        return M + uniform(self.run.bars, touched[left], a[left], b[left], np.ones(len(left)))
