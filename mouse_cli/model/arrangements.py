"""What a diagnosis of one structure in several arrangements found: causes that all share, one after another."""

from dataclasses import dataclass, replace

import numpy as np

from mouse_cli._notebook import Shown
from mouse_cli.model.diagnosis import (
    NAMED,
    NOTHING,
    ONE_OF,
    RIVAL,
    UNKNOWN,
    Choices,
    Diagnosis,
    Explanation,
    Field,
    HeldOut,
    Rest,
    Score,
    Site,
    Untried,
    elsewhere,
    foremost,
    members,
)
from mouse_cli.model.groups import leading
from mouse_cli.model.prediction import REFUTED
from mouse_cli.model.problem import Problem
from mouse_cli.model.theory import Theory

_EVERY = Choices()


@dataclass(frozen=True)
class Turn:
    """What was found missing beside all causes before. kind: NAMED, ONE_OF, or UNKNOWN where none is better than none.

    explanations: all that were tried, most probable first; groups with their probabilities; noise_scale as in `Diagnosis`. before:
    what the model without a further cause leaves; held: how the model with the leading cause predicts arrangements held out.
    """

    kind: str
    explanations: tuple[Explanation, ...]
    groups: tuple[tuple[str, float], ...]
    noise_scale: float
    before: Explanation
    held: Score | None = None

    @property
    def best(self) -> Explanation:
        """The explanation that stands for the leading group, one with a cause where there is any."""
        groups = [one.group for one in self.explanations]
        return foremost(self.explanations, groups[leading(self.groups, groups)])

    @property
    def probability(self) -> float:
        """Of the group of `best`."""
        return dict(self.groups)[self.best.group]

    @property
    def members(self) -> tuple[tuple[str, float], ...]:
        """Physics of the group of `best` and the probability of each within it, the largest first."""
        return members(self.explanations, self.best.group)

    @property
    def elsewhere(self) -> tuple[tuple[tuple[Site, ...], float], ...]:
        """Rival sites of `best`, and the probability of each among its sites."""
        return elsewhere(self.explanations, self.best)

    @property
    def gain(self) -> float:
        """Nats over no further cause, at the noise scale."""
        return (self.best.log_evidence - self.before.log_evidence) / self.noise_scale

    @property
    def rivals(self) -> tuple[Explanation, ...]:
        """What stands for each group that holds more than 5 % of the probability, none among them."""
        stand = [foremost(self.explanations, name) for name, p in self.groups if p > RIVAL]
        return tuple(filter(None, stand))


@dataclass(frozen=True)
class SharedError:
    """What theory errs in ln f of a mode in every arrangement alike: value and sd."""

    mode: int
    value: float
    sd: float


@dataclass(frozen=True)
class Compared:
    """Tests before and after, each beside the other: chi-square on dof, and the probability p of a difference so large by noise."""

    chi2: float
    dof: int
    p: float

    @property
    def alike(self) -> bool:
        """Whether they differ by no more than noise."""
        return self.p > REFUTED


@dataclass(frozen=True)
class ArrangementsDiagnosis(Shown):
    """The answer for several arrangements of one structure.

    problems: their decks, as they are; changed: which of them have the causes that were sought, None for all; extended: with every
    cause that was told. common_sd: of ln f, of theory, the same in all arrangements. turns: causes in the order in which they were
    told. chi2 on dof with probability p: what is left with all of them. values, sd (q,): of the parameters of the extended decks.
    rest: what was tried beside all of them and is not demanded, that without a further cause first. held_out: arrangements that no
    fit has seen, before the first cause and after the last. field: physics without a name where the answer is UNKNOWN; untried:
    candidates left out. tests: those before and after, each beside the other; None where they cannot be compared. unsought: why no
    change was sought, in a sentence; empty: one was. state: what the state before lacks by itself, where that was asked.
    """

    problems: tuple[Problem, ...]
    changed: tuple[bool, ...] | None
    extended: tuple[Problem, ...]
    common_sd: float
    turns: tuple[Turn, ...]
    chi2: float
    dof: int
    p: float
    adequate: bool
    values: np.ndarray
    sd: np.ndarray
    shared: tuple[SharedError, ...]
    rest: tuple[Explanation, ...]
    held_out: HeldOut | None = None
    refuted: str = ""
    choices: Choices = _EVERY
    remarks: tuple[str, ...] = ()
    field: Field | None = None
    untried: tuple[Untried, ...] = ()
    tests: Compared | None = None
    unsought: str = ""
    state: Diagnosis | None = None

    @property
    def problem(self) -> Problem:
        """The deck of the first arrangement."""
        return self.problems[0]

    @property
    def theory(self) -> Theory:
        """Errors of theory that were allowed for: those of the decks, with the common sd that was used."""
        return replace(self.problem.theory, configurations=self.common_sd)

    @property
    def kind(self) -> str:
        """NOTHING is missing; NAMED, every cause; ONE_OF, some cause is not settled; UNKNOWN, more is left than noise.

        Of what changed nothing is missing where the tests before and after are alike, whatever the model leaves of both.
        """
        if self.unchanged:
            return NOTHING
        if not self.adequate:
            return UNKNOWN
        if not self.turns:
            return NOTHING
        return NAMED if all(turn.kind == NAMED for turn in self.turns) else ONE_OF

    @property
    def unchanged(self) -> bool:
        """Whether the tests say by themselves that nothing has changed that they could show."""
        return self.tests is not None and self.tests.alike and not self.turns

    @property
    def begun(self) -> bool:
        """Whether what the state before lacks is in all of `problems`."""
        return self.state is not None and not self.unsought

    @property
    def remaining(self) -> Rest | None:
        """What remains of the misfit of the model as it is where causes were found and do not explain all; else None."""
        if self.adequate or not self.turns:
            return None
        return Rest(self.chi2 / self.turns[0].before.chi2, self.p)

    @property
    def exit_code(self) -> int:
        """0: nothing is missing; 1: something is."""
        return 0 if self.kind == NOTHING and not self.begun else 1
