"""Locate, name, model, prove: the whole of a diagnosis."""

from collections.abc import Callable
from dataclasses import replace
from functools import partial

import numpy as np

from mouse_cli._errors import NumericalError
from mouse_cli.diagnosis.begun import again, begun
from mouse_cli.diagnosis.cautions import cautions, misstated
from mouse_cli.diagnosis.companions import loose
from mouse_cli.diagnosis.explained import acting, certain, explanations
from mouse_cli.diagnosis.extend.deck import extended
from mouse_cli.diagnosis.gates import GATE
from mouse_cli.diagnosis.likelihoods.measured import Measured
from mouse_cli.diagnosis.likelihoods.modal.model import Model
from mouse_cli.diagnosis.likelihoods.modal.numerics import numerics
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.localise.energy_map import energy_map
from mouse_cli.diagnosis.localise.force import locate
from mouse_cli.diagnosis.localise.implied_law import implied_law
from mouse_cli.diagnosis.nameless.fit import field_of
from mouse_cli.diagnosis.names import by_records, housed, of_modes
from mouse_cli.diagnosis.search.fit import Fit, fit
from mouse_cli.diagnosis.search.rank import Ranking, group, rank
from mouse_cli.diagnosis.search.spread import with_forms
from mouse_cli.diagnosis.validate.informed import informed
from mouse_cli.diagnosis.validate.next_measurement import proposals
from mouse_cli.diagnosis.verdict import Verdict, judge, member, rest
from mouse_cli.dynamics.solver import EigenSolver
from mouse_cli.model.diagnosis import NAMED, NOTHING, ONE_OF, RIVAL, UNKNOWN, Choices, Diagnosis, Proposal
from mouse_cli.model.modal_test import restricted
from mouse_cli.model.problem import Problem
from mouse_cli.model.result import Result
from mouse_cli.updating import refusals
from mouse_cli.updating.chi_square import upper_tail
from mouse_cli.updating.loop import run
from mouse_cli.updating.prior_model import related

Notice = Callable[[str], None]

ENOUGH = 1e-3  # share of the misfit of a large model that is no matter

_ALL = Choices()
_RIVALS = 4  # that are told apart from the leading explanation


def diagnose(problem: Problem, notice: Notice = lambda text: None, choices: Choices = _ALL) -> Diagnosis:
    """What the model of `problem` lacks, judged by its test; choices: which candidates are considered.

    Raises DeckError and NumericalError as `run` does, and NoSite where no candidate of `choices` can act.

    >>> import mouse_cli
    >>> found = mouse_cli.diagnose(mouse_cli.read_deck("decks/ground_spring.yaml"))
    >>> found.kind, found.best.title, found.best.causes[0].site.text
    ('named', 'a spring to the ground', 'degree of freedom 2')
    """
    measured = Measured(problem, choices.candidates)
    if by_records(problem):
        return measured.laws(notice, choices)
    try:
        found, _ = by_its_modes(measured, notice, choices)
    except np.linalg.LinAlgError as reason:  # values that span too many powers of ten for any algebra
        raise refusals.unphysical(problem, str(reason)) from None
    by_laws = measured.laws(notice, choices) if found.kind == NOTHING else None
    return found if by_laws is None else replace(by_laws, remarks=found.remarks + by_laws.remarks)


def by_its_modes(measured: Measured, notice: Notice, choices: Choices) -> tuple[Diagnosis, Verdict]:
    """The same by measured modes, or those that functions show, with all that was measured beside them; and the verdict."""
    first = begun(measured, notice)
    measured, problem, model = first.measured, first.problem, first.model
    housed(model, choices.candidates)
    enough = 0.0 if model.places is None else ENOUGH
    result, remarks = _update(problem, first.kept, notice, _guess(model), enough, first.solver)
    candidates, made = of_modes(choices.candidates), partial(again, problem)
    ranking = rank(model, candidates, choices.causes, measured.ranked, jobs=choices.jobs, again=made)
    ranking = with_forms(informed(ranking))
    verdict, as_it_is = judge(ranking, measured.modes and _shifted(ranking.baseline), model), ranking.baseline
    kind, best, missing = verdict.kind, verdict.best, verdict.kind != NOTHING
    location = locate(as_it_is.model.base) if missing and as_it_is.model.base.data.by_shape else None
    deck, of_deck, unfit = _extended(problem, verdict.put)
    answer = Diagnosis(
        problem=problem,
        kind=kind,
        result=result,
        innovation=result.innovation,
        location=location,
        energy=energy_map(as_it_is) if missing else None,
        law=None if best is None else implied_law(best),
        held_out=verdict.proof,
        refuted=verdict.refuted,
        cautions=(*cautions(ranking, verdict, location), *measured.cautions(_told(ranking, verdict))),
        misstated=misstated(ranking) if missing else None,
        proposals=_proposals(ranking, verdict),
        remarks=(*measured.doubts, *remarks, *measured.remarks(ranking), *first.remarks, *unfit, *(_coarse(deck) if deck else ())),
        extended=deck and measured.extended(deck, verdict.put),
        extended_result=deck and _update(deck, of_deck, notice, _values(deck, verdict.put), enough)[0],
        choices=choices,
        field=verdict.field and field_of(ranking, verdict.field, verdict.field_proof),
        rest=rest(ranking) if kind == NAMED else None,
        **_open(verdict),
        **_tried(ranking),
        **measured.compared(ranking, best if missing else None),
    )
    return answer, verdict


def _extended(problem: Problem, put: Fit | None) -> tuple[Problem | None, np.ndarray | None, tuple[str, ...]]:
    """The deck with what a fit has in it, mask (m,) of the modes that have to do with it, and why there is no such deck."""
    deck = put and extended(problem, put)
    if not deck:
        return None, None, ()
    try:
        return deck, related(deck), ()
    except NumericalError:  # a mean of fields, each of which leaves a mass
        return None, None, ("no deck with the change in it: at its mean value the matrices are not those of a structure",)


def _shifted(baseline: Fit) -> bool:
    """Whether the parameters of the model as it is had to move farther from their prior than chance moves them."""
    z = baseline.point.x[: baseline.model.k]
    return len(z) > 0 and upper_tail(float(z @ z), len(z)) < GATE


def _tried(ranking: Ranking) -> dict[str, object]:
    """What was tried, and how probable it is."""
    common = {name: getattr(ranking, name) for name in ("groups", "noise_scale", "untried")}
    return common | {"explanations": explanations(ranking)}


def _told(ranking: Ranking, verdict: Verdict) -> Fit:
    """The explanation that an answer is about: none where nothing is missing, else that which leads."""
    return ranking.baseline if verdict.kind == NOTHING else verdict.best or ranking.fits[0]


def _open(verdict: Verdict) -> dict[str, object]:
    """What is certain where companions are open, whether the site is no longer, and where a place is not."""
    open_ = {"certain": verdict.certain and certain(verdict.best, verdict.certain), "placed": verdict.placed}
    return open_ | {"loose": loose(verdict.best, verdict.sure) if verdict.kind == NAMED else ()}


def _by_modes(problem: Problem) -> Problem:
    """The deck with its modes alone, where FRFs showed them they are not to be counted twice; and with more error of theory in
    their sd where the deck allows for more than usual.
    """
    return replace(problem, frf=(), test=problem.theory.beyond_default(problem.test))


def _guess(model: Reduced) -> np.ndarray | None:
    """Values (p,) of the parameters of a large model that fit its test in few coordinates, so that the update has it near."""
    update = None if model.places is None else fit(Model(model), np.zeros(0))
    return None if update is None else model.parameters(update.point.x)


def _values(deck: Problem, best: Fit) -> np.ndarray:
    """Values of the parameters of the extended deck that its fit found: those of the deck first, then sizes of causes."""
    own = best.model.base.parameters(best.point.x[: best.model.k])
    return np.concatenate([own, deck.prior.mean[len(own) :]])


def _update(
    problem: Problem,
    kept: np.ndarray,
    notice: Notice,
    guess: np.ndarray | None,
    enough: float,
    solver: EigenSolver | None = None,
) -> tuple[Result, tuple[str, ...]]:
    """The update of a model by those modes (mask `kept`) that have to do with it; what to say of the others."""
    problem, lost = _by_modes(problem), ", ".join(str(number) for number in problem.test.number[~kept])
    if kept.all() or not kept.any():
        return run(problem, notice=notice, guess=guess, enough=enough, solver=solver, search=False), ()
    message = f"no mode of the model is like measured mode {lost}: the update of the model as it is goes without"
    own = replace(problem, test=restricted(problem.test, kept))
    return run(own, notice=notice, guess=guess, enough=enough, solver=solver, search=False), (message,)


def _coarse(deck: Problem) -> tuple[str, ...]:
    """What to say of the mesh of the extended deck."""
    sd = deck.test.frequency_sd_hz / deck.test.frequency_hz
    known = np.isfinite(sd)
    found = numerics(deck, deck.prior.mean, deck.test.number[known] - 1, sd[known])
    return tuple(f"with the mechanism: {text}" for text in replace(found, finer=None).remarks)


def _proposals(ranking: Ranking, verdict: Verdict) -> tuple[Proposal, ...]:
    """What would separate the leading cause from other sites of it, or from no cause, or from those that lead other groups."""
    best = verdict.best
    if best is None or verdict.kind in (NOTHING, UNKNOWN):
        return ()
    if not verdict.placed:
        sites = [best, *(other for i, (other, share) in enumerate(best.elsewhere[:_RIVALS]) if i == 0 or share > RIVAL)]
        return proposals(sites, [acting(one) for one in sites]) if len(sites) > 1 else ()
    names = {group(ranking.fits[i]) for i in ranking.named}
    others = [(name, p) for name, p in ranking.groups if name in names and name not in (group(best), *verdict.refuted)]
    rivals = [name for name, p in others if p > RIVAL]
    if verdict.kind == ONE_OF and not rivals:
        rivals = [name for name, _ in others[:1]]
    if not rivals:
        return ()
    fits = [best, *(member(ranking, name) for name in rivals[:_RIVALS])]
    return proposals(fits, [group(one) for one in fits])
