"""Modes that a cause makes and that nobody measured: what they say against it."""

import numpy as np

from mouse_cli.diagnosis.likelihoods.modal.data import Data
from mouse_cli.diagnosis.likelihoods.modal.model import Model
from mouse_cli.diagnosis.likelihoods.modal.point import Point
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.search.fit import Fit

_RIGID, _VISIBLE = 1e-3, 0.03  # eigenvalue and motion, of measured modes, below which a mode is rigid, or easily missed


def unseen(one: Fit) -> float:
    """Nats against mechanisms with a mode of their own that the test does not have, though its sensors would have seen it.

    Of a mode below the highest measured one whose largest component is r times that of those measured (unit modal masses), a test
    misses 1 in 1 + (r / 0.03)^2: what responds at resonance goes with r^2. Where the test counts that mode, nothing.
    """
    return sum(max(0.0, _surprise(parts[0]) - _surprise(parts[1])) for parts in _pairs(one))


def unmeasured_hz(one: Fit) -> tuple[float, ...]:
    """Frequencies (Hz) of visible modes below the highest measured one that the mechanisms make and that nobody measured.

    A mode that the model has as it is, unseen, and that a mechanism makes visible, is none: `unseen` weighs it, no more.
    """
    found: list[float] = []
    for own, bare in _pairs(one):
        more = min(int((own[1] > 1).sum() - (bare[1] > 1).sum()), len(own[0]) - len(bare[0]))
        order = np.argsort(-own[1])[: max(more, 0)]
        found += [float(hz) for hz in own[0][order]]
    return tuple(sorted(found))


Missed = tuple[np.ndarray, np.ndarray]  # frequencies (Hz) and motion over what is easily missed, of modes not measured


def _pairs(one: Fit) -> list[tuple[Missed, Missed]]:
    """What each arrangement misses with the mechanisms, and without them; none where the test counts those modes."""
    found = []
    for model, at in one.model.parts(one.point):
        bare = Model(model.base).point(at.x[: model.k])
        if bare is not None and at.modes.size and at.modes.max() + 1 > model.base.data.test.number.max():
            held = _held(model.base)
            found.append((_missed(at, held), _missed(bare, held)))
    return found


def _held(base: Reduced) -> Data | None:
    """The modes that the deck holds out, which are none of those fitted; None without any."""
    held = base.problem.hold_out
    return (
        base.with_test(held.test, base.data.test).data
        if held is not None and held.test is not None and held.test.m
        else None
    )


def _missed(at: Point, held: Data | None) -> Missed:
    """Modes of `at` between rigid ones and the highest measured one that the test has not, fitted or held out."""
    measured, size = at.eigenvalues[at.modes], np.abs(at.seen).max(axis=0, initial=0.0)
    between = (at.eigenvalues > _RIGID * measured.min()) & (at.eigenvalues < measured.max())
    between[at.modes] = False
    if held is not None:
        others = held.pair(at.eigenvalues, at.seen)
        between[others[others < len(between)]] = False
    return np.sqrt(at.eigenvalues[between]) / (2 * np.pi), size[between] / np.median(size[at.modes]) / _VISIBLE


def _surprise(missed: Missed) -> float:
    """ln of how rarely a test misses all of these."""
    return float(np.log1p(missed[1] ** 2).sum())
