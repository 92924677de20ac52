"""Modes that a cause makes and that nobody measured: what they say against it."""

import numpy as np

from mouse_cli.diagnosis.likelihoods.modal.model import Model, Point
from mouse_cli.diagnosis.search.fit import Fit

_RIGID, _VISIBLE = 1e-3, 0.03  # eigenvalue and motion, of measured modes, below which a mode is rigid, or easily missed


def unseen(one: Fit) -> float:
    """Nats against causes with a mode of their own that the test does not have, though its sensors would have seen it.

    Of a mode below the highest measured one whose largest component is r times that of those measured (unit modal masses), a test
    misses 1 in 1 + (r / 0.03)^2: what responds at resonance goes with r^2. Where the test counts that mode, nothing.
    """
    return sum(_in_one(model, at) for model, at in one.model.parts(one.point))


def _in_one(model: Model, at: Point) -> float:
    """The same of one arrangement."""
    bare = Model(model.base).point(at.x[: model.k])
    if bare is None or not at.modes.size or at.modes.max() + 1 <= model.base.data.test.number.max():
        return 0.0
    return max(0.0, _missed(at) - _missed(bare))


def _missed(at: Point) -> float:
    """ln of how rarely a test misses what `at` has between rigid modes and the highest measured one, and the test has not."""
    measured, size = at.eigenvalues[at.modes], np.abs(at.seen).max(axis=0, initial=0.0)
    between = (at.eigenvalues > _RIGID * measured.min()) & (at.eigenvalues < measured.max())
    between[at.modes] = False
    return float(np.log1p((size[between] / np.median(size[at.modes]) / _VISIBLE) ** 2).sum())
