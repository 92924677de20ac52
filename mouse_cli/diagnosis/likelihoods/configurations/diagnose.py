"""What arrangements of one structure lack, one cause after another: each is put into all decks before the next is sought."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from mouse_cli.diagnosis.explained import explanation, explanations
from mouse_cli.diagnosis.extend.deck import in_its_units
from mouse_cli.diagnosis.extend.halves import halved
from mouse_cli.diagnosis.likelihoods.configurations.checked import checked
from mouse_cli.diagnosis.likelihoods.configurations.compared import compared
from mouse_cli.diagnosis.likelihoods.configurations.erring import Before, before
from mouse_cli.diagnosis.likelihoods.configurations.judged import by_leading
from mouse_cli.diagnosis.likelihoods.configurations.model import Arranged, SharedRecipe, Together, lowest_of
from mouse_cli.diagnosis.likelihoods.configurations.predict import placed, predicted, shared_errors
from mouse_cli.diagnosis.likelihoods.configurations.shared import Errors
from mouse_cli.diagnosis.likelihoods.configurations.sought import Sought
from mouse_cli.diagnosis.likelihoods.modal.meshed import HALVINGS, Meshed, meshed
from mouse_cli.diagnosis.nameless.fit import field_of, rivals
from mouse_cli.diagnosis.search.escape import uncrossed
from mouse_cli.diagnosis.search.fit import Fit, fit
from mouse_cli.diagnosis.search.rank import Ranking, rank, ranking, unnamed
from mouse_cli.diagnosis.verdict import (
    ODDS,
    SURE,
    doubtful,
    explains,
    far_parameters,
    leader,
    sure,
)
from mouse_cli.model.arrangements import ArrangementsDiagnosis, Compared, Turn
from mouse_cli.model.diagnosis import BY_DECK, NAMED, ONE_OF, Choices, Field, HeldOut, Score
from mouse_cli.model.problem import Problem
from mouse_cli.updating import refusals

_MOST = 8  # causes that are told one after another
_ALL = Choices()


@dataclass(frozen=True)
class Decks:
    """Decks (a,) of arrangements, and which of them have the causes that are sought.

    common_sd: of ln f, of what theory errs in all of them alike, as a rule theory.configurations of the decks. erring: what it
    does in their models before anything was found; None: in these.
    """

    problems: tuple[Problem, ...]
    having: tuple[bool, ...]
    common_sd: float
    erring: Errors | None = None

    @cached_property
    def arranged(self) -> Arranged:
        """As one model."""
        pairs = zip(self.meshed, self.having, strict=True)
        parts = tuple(lowest_of(each.model, has) for each, has in pairs)
        return Arranged(parts, self.common_sd, self.having, self.erring)

    def model(self) -> Arranged:
        """The same, made once more by another process."""
        return self.arranged

    @cached_property
    def meshed(self) -> tuple[Meshed, ...]:
        """The model of each, corrected for its mesh.

        Raises NumericalError where one is no structure, such as a member that is gone under an axial force.
        """
        try:
            return tuple(meshed(each) for each in self.problems)
        except np.linalg.LinAlgError as reason:
            raise refusals.unphysical(self.problems[0], str(reason)) from None

    def halved(self) -> "Decks":
        """The same on elements of half the length."""
        return replace(self, problems=tuple(halved(each) for each in self.problems))

    def extended(self, one: Fit) -> "Decks":
        """The same with the mechanisms of a fit in them."""
        found = replace(self, erring=self._errors(one))
        for recipe, own in zip(one.recipes, one.model.own, strict=True):
            found = found._with(recipe, one.c[own])
        return found

    def _with(self, recipe: SharedRecipe, coordinates: np.ndarray) -> "Decks":
        if not self.problems:
            return self
        own = len(self.problems[0].parameters)
        found = self.arranged.like(recipe).extended(self.problems, coordinates)
        return replace(self, problems=tuple(in_its_units(each, own) for each in found))

    def _errors(self, one: Fit) -> Errors | None:
        """What theory errs in them with the mechanisms of a fit."""
        if not self.problems:
            return None
        there = placed(one, self.arranged)
        modes = there and there[0].modes(there[1])
        return Errors(modes, self.common_sd) if modes else self.arranged.errors


@dataclass(frozen=True)
class State:
    """Decks with the causes that were told so far, those held out among them, and what further candidates make of them.

    tests: those before and after, each beside the other, where no cause was told yet.
    """

    fitted: Decks
    unseen: Decks
    ranking: Ranking
    before: Score | None
    tests: Compared | None = None


def diagnose_arrangements(
    fitted: Decks,
    unseen: Decks,
    notice: Callable[[str], None] = lambda text: None,
    choices: Choices = _ALL,
) -> ArrangementsDiagnosis:
    """Causes that `fitted` share, proved on `unseen`.

    Raises DeckError when decks are no arrangements of one structure (MD690, MD691).
    """
    checked((*fitted.problems, *unseen.problems))
    fitted, unseen, remarks = on_short_elements(fitted, unseen)
    remarks += tuple(dict.fromkeys(text for each in fitted.meshed for text in each.remarks))
    fitted, unseen, state = _as_theory_errs(fitted, unseen)
    sought = Sought(choices, state)
    first = at = _state(fitted, unseen, sought)
    turns: list[Turn] = []
    refuted = ""
    while len(turns) < _MOST and not refuted:
        turn, best = _turn(at)
        if turn is None:
            break
        if _better(at, turn.held) < -ODDS:
            refuted = turn.best.title
            continue
        turns.append(turn)
        notice(f"{len(turns)}: {turn.best.title}")
        at = _state(at.fitted.extended(best), at.unseen.extended(best), sought, at)
    held = _held_out(unseen.problems, first.before, at.before if turns else None)
    found = _answer(fitted, first.tests, at, tuple(turns), held, refuted, choices)
    found = replace(found, remarks=remarks + (state.remarks if state else ()), unsought=sought.refused)
    if found.unsought:
        return replace(found, shared=())  # of a fit that has to explain the state after as well
    return found if found.adequate or found.unchanged else replace(found, field=_field(at))


def on_short_elements(fitted: Decks, unseen: Decks) -> tuple[Decks, Decks, tuple[str, ...]]:
    """Both on elements short enough for all of their tests, and what to say of those that were halved; see `begun`."""
    said: tuple[str, ...] = ()
    for _ in range(HALVINGS):
        coarse = [own for decks in (fitted, unseen) for own in zip(decks.meshed, decks.problems, strict=True) if own[0].coarse]
        if not coarse:
            break
        found, problem = coarse[0]
        said += (found.said(problem),)
        fitted, unseen = fitted.halved(), unseen.halved()
    return fitted, unseen, said


def _as_theory_errs(fitted: Decks, unseen: Decks) -> tuple[Decks, Decks, Before | None]:
    """Both with errors of theory as large as the state before asks, and what it asks."""
    found = before(fitted.arranged)
    if found is None or found.tau == found.stated:
        return fitted, unseen, found
    return *(replace(each, common_sd=found.tau) for each in (fitted, unseen)), found


def _answer(
    fitted: Decks,
    tests: Compared | None,
    at: State,
    turns: tuple[Turn, ...],
    held: HeldOut | None,
    refuted: str,
    choices: Choices,
) -> ArrangementsDiagnosis:
    """The answer, from the decks `fitted` as they were, their tests, and the state `at` in which the search ended."""
    last, tried = at.ranking.baseline, explanations(at.ranking)
    told = next(one for one in tried if not one.causes)
    adequate = not doubtful(last, False) and (bool(turns) or not _differ(tests))
    if not adequate and not explains(last):  # a step that leaves too much, and all after it, is no name
        turns = tuple(replace(turn, kind=ONE_OF) for turn in turns)
    return ArrangementsDiagnosis(
        problems=fitted.problems,
        changed=None if all(fitted.having) else fitted.having,
        extended=at.fitted.problems if turns else (),
        common_sd=fitted.common_sd,
        turns=turns,
        chi2=last.misfit,
        dof=last.dof,
        p=told.p,
        adequate=adequate,
        values=told.theta,
        sd=_sd(last),
        shared=shared_errors(last),
        rest=(told, *(one for one in tried if one.causes)),
        held_out=held,
        refuted=refuted,
        choices=choices,
        untried=at.ranking.untried,
        tests=tests,
    )


def _field(at: State) -> Field | None:
    """What is left beside all mechanisms, where it has no name and yet explains the data better than nothing."""
    baseline, fits = at.ranking.baseline, list(at.ranking.fits)
    if not any(one.nameless for one in fits):
        fits += rivals(at.fitted.arranged, baseline, Together)
    found = ranking(baseline, fits)
    i = next((i for i, one in enumerate(found.fits) if one.nameless), None)
    return None if i is None or not found.log_odds[i] > ODDS else field_of(found, found.fits[i])


def _state(fitted: Decks, unseen: Decks, sought: Sought, last: State | None = None) -> State:
    """What candidates make of decks as they are: of what changed together, of what all have one after another.

    last: the state with one mechanism less. Where sets of what changed were sought there, and the one that led leaves no more
    than noise, nothing that decks held out could confirm is sought again; nor is it where tests show no change by themselves, or
    the model does not explain the state before.
    """
    changed, none = not all(fitted.having), uncrossed(fit(Together(fitted.arranged), np.zeros(0)))
    tests = compared(fitted.arranged) if changed and last is None else None
    over = not doubtful(none, False) if last is not None else tests is not None and tests.alike
    if changed and (sought.refused or (over and not unseen.problems)):
        untried = () if last is None else last.ranking.untried
        return State(fitted, unseen, replace(ranking(none, [none]), untried=untried), _predicted(none, unseen), tests)
    causes, again = sought.choices.causes if changed else 1, replace(fitted).model
    known, jobs = sought.known(changed), sought.choices.jobs
    found = rank(fitted.arranged, known, causes, by_leading, kind=Together, last=changed, jobs=jobs, again=again)
    return State(fitted, unseen, found, _predicted(none, unseen), tests)


def _predicted(one: Fit, unseen: Decks) -> Score | None:
    return predicted(one, unseen.arranged) if unseen.problems else None


def _turn(at: State) -> tuple[Turn | None, Fit | None]:
    """The next cause, where one is demanded: by what is left, by tests that differ, or by evidence that arrangements held out
    confirm.
    """
    ranking, best = at.ranking, leader(at.ranking)
    demanded = doubtful(ranking.baseline, False) or _differ(at.tests)
    if best is None or not _has_name(ranking, best) or not (demanded or (at.unseen.problems and sure(ranking))):
        return None, None
    gain = ranking.log_odds[next(i for i, one in enumerate(ranking.fits) if one is best)]
    held = _predicted(best, at.unseen)
    if at.unseen.problems and held is None:
        return None, None  # what is kept to prove it cannot
    if gain < ODDS or not (demanded or _better(at, held) > ODDS):
        return None, None
    before = explanation(ranking.baseline)
    turn = Turn(ONE_OF, explanations(ranking), ranking.groups, ranking.noise_scale, before, held)
    return replace(turn, kind=NAMED if turn.probability > SURE and not far_parameters(best) else ONE_OF), best


def _differ(tests: Compared | None) -> bool:
    """Whether tests before and after say by themselves that something has changed."""
    return tests is not None and not tests.alike


def _has_name(ranking: Ranking, best: Fit) -> bool:
    """Whether what leads has a name, and can be put into decks."""
    return unnamed(ranking.fits[0]) is None and all(recipe.extend is not None for recipe in best.recipes)


def _better(at: State, held: Score | None) -> float:
    """Nats by which arrangements held out are predicted better with a cause than without; 0 where nothing tells."""
    return 0.0 if held is None or at.before is None else held.log_predictive_density - at.before.log_predictive_density


def _sd(one: Fit) -> np.ndarray:
    """sd (p,) of the parameters."""
    base, z = one.model.base, one.point.x[: one.model.k]
    first = base.parts[0]
    slope = first.coordinates.slope(first.coordinates.mean + base.L @ z)[:, None] * base.L
    return np.sqrt(np.einsum("pi,ij,pj->p", slope, one.covariance[: len(z), : len(z)], slope))


def _held_out(unseen: tuple[Problem, ...], before: Score | None, after: Score | None) -> HeldOut | None:
    if before is None:
        return None
    labels, measured = [], []
    for each in unseen:
        have = np.isfinite(each.test.frequency_hz)
        labels += [f"{each.title.strip()}, mode {number}" for number in each.test.number[have]]
        measured.append(each.test.frequency_hz[have])
    return HeldOut(BY_DECK, tuple(labels), np.concatenate(measured), before, after)
