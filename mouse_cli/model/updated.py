"""What a method of updating says of itself, and what it found; reports read it and compute nothing."""

from dataclasses import dataclass, field

import numpy as np

from mouse_cli._errors import Diagnostic
from mouse_cli._notebook import Shown
from mouse_cli.model.arrays import Matrix
from mouse_cli.model.conditioning import Conditioning
from mouse_cli.model.problem import Problem

ASPECTS = ("measured modes", "definiteness", "rigid-body modes", "sparsity", "physical meaning")
KEPT, LOST, PARTLY = "yes", "no", "in part"
UNTRUSTED = 1  # exit code


@dataclass(frozen=True)
class Guarantee:
    """One of ASPECTS: whether the answer has it for any data (KEPT, LOST, PARTLY), and why."""

    aspect: str
    given: str
    why: str


@dataclass(frozen=True)
class About:
    """A method as reports name it: title, equation, its source, and one Guarantee for each of ASPECTS."""

    key: str
    title: str
    equation: str
    source: str
    guarantees: tuple[Guarantee, ...]

    @property
    def physical(self) -> bool:
        """Whether the answer is a model of a structure, and not only a matrix that reproduces data."""
        return next(g for g in self.guarantees if g.aspect == ASPECTS[-1]).given != LOST


@dataclass(frozen=True)
class Moved:
    """A property that a method revised, in `unit`, before and after."""

    name: str
    unit: str
    before: float
    after: float


@dataclass(frozen=True)
class Predicted:
    """k modes of one configuration: mode numbers, Hz as measured with sd, before and after; mac (k,), NaN without shapes.

    fitted: the method has used them.
    """

    title: str
    fitted: bool
    number: np.ndarray
    test_hz: np.ndarray
    test_sd_hz: np.ndarray
    prior_hz: np.ndarray
    revised_hz: np.ndarray
    mac: np.ndarray

    @property
    def rms_percent(self) -> float:
        """Root mean square difference of the revised model from the test, per cent; NaN where a mode is not there."""
        return float(100 * np.sqrt(np.mean((self.revised_hz / self.test_hz - 1) ** 2)))


@dataclass(frozen=True)
class Checked:
    """What became of the guarantees in this answer.

    misfit: largest |(K - lambda M) x| / |lambda M x| of the measured modes, expanded, by their energies; NaN where none was.
    lowest_hz: of the lowest eigenvalue, negative where that is (an imaginary frequency). negative: eigenvalues below zero. rigid,
    rigid_before: those that are zero. filled: elements of K outside of the pattern that the model had, of `stored` within it.
    """

    misfit: float
    lowest_hz: float
    negative: int
    rigid: int
    rigid_before: int
    filled: int
    stored: int


@dataclass(frozen=True)
class Updated(Shown):
    """The answer of one method. configurations: what was fitted first, then what was held out.

    solutions: eigensolutions or iterations that it took; change: relative, in the last one. conditioning: for least squares.
    against: what the method's own tests say against the answer.
    """

    problem: Problem
    about: About
    expansion: str
    K: Matrix
    M: Matrix
    iterations: int
    change: float
    converged: bool
    moved: tuple[Moved, ...]
    configurations: tuple[Predicted, ...]
    checked: Checked
    conditioning: Conditioning | None = None
    against: str = ""
    warnings: tuple[Diagnostic, ...] = ()

    @property
    def exit_code(self) -> int:
        """0: a physical model that keeps what a structure must; 1: not to be trusted beyond the modes that were fitted."""
        return UNTRUSTED if self.warnings else 0


@dataclass(frozen=True)
class Compared(Shown):
    """The answers of several methods to one deck, and what refused the others, by key."""

    problem: Problem
    updates: tuple[Updated, ...]
    refused: dict[str, tuple[Diagnostic, ...]] = field(default_factory=dict)
