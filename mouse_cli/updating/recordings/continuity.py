"""What it is worth that the own motion of a law goes on from where the stretch before has left it.

Stretches have initial states of their own, so that an error of theory does not add up along a record. All hypotheses have those
of the model; those of a law's own degrees of freedom are paid for by it alone, twice in each stretch, though what it does until
then follows from the stretch before. Their prior is therefore where the model with the law arrives, give or take a share of their
spread, over which the evidence is averaged (a Kalman filter over stretches; A. C. Harvey, Forecasting, Structural Time Series
Models and the Kalman Filter, 1989).
"""

from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from mouse_cli.dynamics.response import discrete, simulate
from mouse_cli.updating.recordings.hypothesis import Hypothesis
from mouse_cli.updating.recordings.segments import Segments
from mouse_cli.updating.recordings.simulator import Simulator

# of the spread, that an own state may be elsewhere than where the stretch before leads to
_SHARES = (0.01, 0.03, 0.1, 0.3, 1.0)


@dataclass(frozen=True)
class Stretch:
    """A stretch that was fitted by itself: its initial state (2n,) and the precision of that (2n, 2n) by prior and data; where its
    own states (2a,) are when the next one begins, and how they follow from those in which it begins (2a, 2n).
    """

    begun: np.ndarray
    precision: np.ndarray
    after: np.ndarray
    carried: np.ndarray


def gained(
    simulator: Simulator, x: np.ndarray, states: np.ndarray, spread: np.ndarray, precisions: list[np.ndarray]
) -> float:
    """Nats by which the evidence of a fit x (k,), states (2n, G) is more than by own states of sd `spread` (2n,) in each stretch.

    precisions: of the states of each stretch (2n, 2n), by that prior and the data.
    """
    h, first, total = simulator.h, 0, np.zeros(len(_SHARES))
    if not h.extra:
        return 0.0
    n = len(h.linear.M)
    own = np.r_[n : n + h.extra, 2 * n + h.extra : 2 * (n + h.extra)]
    for part in simulator.data:
        these = slice(first, first + len(part.starts))
        first = these.stop
        internal = [None if one is None else one[:, :, these] for one in simulator.internal or ()]
        after = _after(h, part, x, states[:, these], internal, own)
        stretches = [Stretch(*one) for one in zip(states.T[these], precisions[these], *after, strict=True)]
        total += [_filtered(stretches, own, spread[own], share) for share in _SHARES]
    return float(np.logaddexp.reduce([0.0, *total]) - np.log(1 + len(_SHARES)))


def _after(h: Hypothesis, part: Segments, x: np.ndarray, states: np.ndarray, internal: list, own: np.ndarray):
    """Own states (G, 2a) where each next stretch begins, and their slopes by the states before (G, 2a, 2n), local forces aside."""
    plant, step = h.plant(x[None], part.series), part.series.dt / part.series.factor
    order, motion = np.divmod(own, plant.states // 2)
    reading = replace(plant, sensing=np.eye(plant.states // 2)[motion], order=order)
    advance = discrete(replace(plant, local=plant.local[:, :0]), step).next[0, : plant.states, : plant.states]
    found, slopes = np.zeros((len(part.starts), len(own))), np.zeros((len(part.starts), len(own), plant.states))
    gaps = np.diff(part.starts)
    for gap in np.unique(gaps):
        at, steps = np.flatnonzero(gaps == gap), gap * part.series.factor
        begun = [None if one is None else one[:, None, :, at] for one in internal] or None
        force = replace(part, starts=part.starts[at], length=gap).force[: steps + 1]
        with np.errstate(all="ignore"):
            found[at] = simulate(reading, step, force, states[None][:, :, at], h.local(x[None]), begun)[0, :, -1].T
        slopes[at] = np.linalg.matrix_power(advance, steps)[own]
    return found, slopes


def _filtered(stretches: list[Stretch], own: np.ndarray, spread: np.ndarray, share: float) -> float:
    """Nats gained where own states are within a share of their spread (2a,) of where the stretch before leads to."""
    total, known, moved = 0.0, stretches[0].precision, np.zeros(len(stretches[0].begun))
    for last, stretch in pairwise(stretches):
        variance = last.carried @ np.linalg.solve(known, last.carried.T) + np.diag((share * spread) ** 2)
        gain, known, moved = _of_prior(stretch, own, spread, last.after + last.carried @ moved, variance)
        total += gain
    return total if np.isfinite(total) else -np.inf


def _of_prior(stretch: Stretch, own: np.ndarray, spread: np.ndarray, mean: np.ndarray, variance: np.ndarray):
    """Nats gained by a prior of own states of another mean (2a,) and variance (2a, 2a); the precision of all states (2n, 2n)
    with it, and how far they move (2n,).
    """
    begun, weight = stretch.begun[own], np.linalg.inv(variance)
    away, precision, pull = mean - begun, stretch.precision.copy(), np.zeros(len(stretch.begun))
    precision[np.ix_(own, own)] += weight - np.diag(spread**-2.0)
    pull[own] = weight @ away + begun / spread**2
    moved, size = np.linalg.solve(precision, pull), lambda matrix: np.linalg.slogdet(matrix)[1]
    gain = pull @ moved - away @ weight @ away + ((begun / spread) ** 2).sum()
    gain += size(stretch.precision) - size(precision) + 2 * np.log(spread).sum() - size(variance)
    return gain / 2, precision, moved
