"""What many runs of one deck found: a sweep of what is not known exactly, or a bootstrap of the test."""

from dataclasses import dataclass

import numpy as np

from mouse_cli._errors import Diagnostic
from mouse_cli._notebook import Shown
from mouse_cli.model.problem import Problem


def largest(sizes: np.ndarray) -> int | None:
    """Which size is the largest in absolute value; None where none is known or all are 0."""
    known = np.nan_to_num(np.abs(np.asarray(sizes, float)))
    return int(known.argmax()) if len(known) and known.max() > 0 else None


@dataclass(frozen=True)
class Answered:
    """How one run ended; NaN where it has no answer.

    theta, sd (p,): revised values and standard deviations; hz (m,): revised natural frequencies of the measured modes; chi2, p: of
    the residual; file: the whole answer.
    """

    exit_code: int
    ended: str
    model_form: str
    theta: np.ndarray
    sd: np.ndarray
    hz: np.ndarray
    chi2: float
    p: float
    file: str

    @property
    def found(self) -> bool:
        """Whether there is an answer, trusted or not."""
        return bool(np.isfinite(self.theta).all())


@dataclass(frozen=True)
class Moved:
    """By how much one parameter or frequency moves over a sweep.

    lengths: highest less lowest in (median) posterior sd; shares: of its variance that each varied quantity explains by itself.
    """

    name: str
    unit: str
    low: float
    high: float
    sd: float
    lengths: float
    shares: tuple[float, ...]

    @property
    def most_by(self) -> int | None:
        """Which varied quantity moves it most; None where nothing does."""
        return largest(np.array(self.shares))


@dataclass(frozen=True)
class Sweep(Shown):
    """points[i] are the values of the `varied` quantities at which answers[i] was found."""

    problem: Problem
    varied: tuple[str, ...]
    points: tuple[tuple[float | int | str | bool, ...], ...]
    answers: tuple[Answered, ...]
    parameters: tuple[Moved, ...]
    frequencies: tuple[Moved, ...]
    exit_code: int
    warnings: tuple[Diagnostic, ...] = ()


@dataclass(frozen=True)
class Spread:
    """One parameter or frequency: the value of the run and its posterior sd, and what resampling of the test makes of it.

    predicted: standard deviation of the resampled values, to first order, were the stated accuracies right; sd: what it is.
    bias: mean less the value. percentile, bca (2,): 95 per cent intervals. jackknife: sd by leaving out one at a time; influence:
    what leaving out each mode and sensor changes, in posterior sd.
    """

    name: str
    unit: str
    value: float
    posterior_sd: float
    predicted: float
    sd: float
    bias: float
    percentile: np.ndarray
    bca: np.ndarray
    jackknife: float
    influence: np.ndarray

    @property
    def most_influential(self) -> int | None:
        """The unit without which the value moves most; None where none is known."""
        return largest(self.influence)


@dataclass(frozen=True)
class Bootstrap(Shown):
    """over: `modes`, `sensors` or `both`. answer: of the deck itself. units: names of what is drawn or left out.

    left_out, replicates: the runs; counts: how often each unit was drawn in each replicate.
    """

    problem: Problem
    over: str
    seed: int
    answer: Answered
    units: tuple[str, ...]
    left_out: tuple[Answered, ...]
    replicates: tuple[Answered, ...]
    counts: np.ndarray
    parameters: tuple[Spread, ...]
    frequencies: tuple[Spread, ...]
    exit_code: int
    warnings: tuple[Diagnostic, ...] = ()
