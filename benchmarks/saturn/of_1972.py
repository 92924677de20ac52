"""The loop of 1972 on a vehicle whose upper half may fluctuate, and the test of the model's form that it did not make."""

from dataclasses import dataclass, replace

import numpy as np

from benchmarks.saturn.decks import upper_half
from benchmarks.saturn.stack import MEASURED, Vehicle
from benchmarks.saturn.vehicle import problem
from mouse_cli.updating import run

_PARTIALS = 20  # cycles at most
_FORCED = 3  # cycles where the data lie within their limits from the beginning, so that the loop would not begin


@dataclass(frozen=True)
class Update:
    """modes: how many were fitted. status, cycles: how the loop ended. p: of the innovation, before any cycle.

    factors (14,): on EI, at the end; of a loop that broke, those that its last cycle asked for.
    """

    modes: int
    status: str
    cycles: int
    factors: np.ndarray
    p: float


def update(vehicle: Vehicle, modes: int) -> Update:
    """Modes 1 to `modes` given to the recursion that replaces its prior."""
    deck = problem(upper_half(vehicle, MEASURED[:modes]))
    options = replace(deck.run, recursion="replaced", partials=_PARTIALS, print_partials=True)
    result = run(replace(deck, run=options))
    if len(result.cycles) == 1 and result.status.key == "converged":
        result = run(replace(deck, run=replace(options, cycles=_FORCED)))
    broken = result.status.key == "indefinite"
    factors = _one_cycle(result) if broken else result.revised.theta
    return Update(modes, result.status.key, len(result.cycles) - (not broken), factors, result.innovation.p)


def _one_cycle(result) -> np.ndarray:
    """O-6 and O-7 from where the loop broke off: theta + S T'(R + T S T')^-1 (y - h)."""
    prior, T = result.problem.prior, result.T
    W = prior.dense() @ T.T @ np.linalg.inv(np.diag(result.sd**2) + T @ prior.dense() @ T.T)
    return result.revised.theta + W @ (result.y - result.revised.predicted)
