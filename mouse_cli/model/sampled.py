"""What `mouse sample` found: the posterior by samples, beside the normal density of the run."""

from dataclasses import dataclass

import numpy as np

from mouse_cli._errors import Diagnostic
from mouse_cli._notebook import Shown
from mouse_cli.model.problem import Problem
from mouse_cli.model.result import Result

_DOUBTS = ("MD550", "MD942", "MD943", "MD945")


@dataclass(frozen=True)
class Sampling:
    """How to sample. steps: most steps of each walker; walkers: 0 for four to a parameter, sixteen at least."""

    steps: int = 20_000
    walkers: int = 0
    seed: int = 1
    processes: int = 1


@dataclass(frozen=True)
class Quantity:
    """One parameter or natural frequency: the mean and sd of the normal density, and those of the samples.

    quantiles (5,): 2.5, 16, 50, 84 and 97.5 per cent. tau: integrated autocorrelation time in steps; size: effective sample size;
    r_hat: split, rank-normalised, over walkers. measured, predicted (2,): of a frequency, the measured one, and between what a new
    measurement of the stated accuracy would lie with 95 per cent.
    """

    name: str
    unit: str
    normal_mean: float
    normal_sd: float
    mean: float
    sd: float
    quantiles: np.ndarray
    tau: float
    size: float
    r_hat: float
    measured: float = np.nan
    predicted: np.ndarray | None = None


@dataclass(frozen=True)
class PosteriorMode:
    """A place of highest posterior density: values theta (p,), J there, and the share of the samples nearest to it."""

    theta: np.ndarray
    cost: float
    share: float


@dataclass(frozen=True)
class Chain:
    """After burn-in: theta (s, w, p) in the units of the parameters, log_posterior (s, w) but for a constant, hz (s, w, m)."""

    theta: np.ndarray
    log_posterior: np.ndarray
    hz: np.ndarray


@dataclass(frozen=True)
class Sampled(Shown):
    """The chain after `burn` of `steps` steps. result: of the run it began from; k_hat: of `draws` from the normal density of that.

    long_enough: 50 autocorrelation times at least, and walkers that agree. acceptance: share of the steps that were taken.
    """

    problem: Problem
    result: Result
    parameters: tuple[Quantity, ...]
    frequencies: tuple[Quantity, ...]
    modes: tuple[PosteriorMode, ...]
    chain: Chain
    steps: int
    burn: int
    tau: float
    acceptance: float
    long_enough: bool
    k_hat: float
    draws: int
    evaluations: int
    seed: int
    warnings: tuple[Diagnostic, ...] = ()

    @property
    def doubtful(self) -> bool:
        """Whether the normal density is no substitute for the posterior, for any of the reasons among the warnings."""
        return any(each.code in _DOUBTS for each in self.warnings)

    @property
    def exit_code(self) -> int:
        """1 where the chain is too short to be believed, or the data reject the form of the model."""
        return int(not self.long_enough or self.result.rejected)
