"""Locate, name, model, prove: the whole of a diagnosis."""

from collections.abc import Callable
from dataclasses import replace

from mouse_cli.diagnosis.decide import decide, explanations
from mouse_cli.diagnosis.extended import extended
from mouse_cli.diagnosis.fit import Fit
from mouse_cli.diagnosis.implied_law import implied_law
from mouse_cli.diagnosis.name import Ranking, group, rank
from mouse_cli.diagnosis.next_measurement import proposals
from mouse_cli.diagnosis.prove import held_out
from mouse_cli.diagnosis.reduced import reduced
from mouse_cli.model.diagnosis import NAMED, NOTHING, ONE_OF, Diagnosis, Proposal
from mouse_cli.model.problem import Problem
from mouse_cli.updating.loop import run

Notice = Callable[[str], None]


def diagnose(problem: Problem, notice: Notice = lambda text: None) -> Diagnosis:
    """What the model of `problem` lacks, judged by its test.

    Raises DeckError and NumericalError as `run` does.
    """
    problem = replace(problem, run=replace(problem.run, recursion="anchored", estimator="bayes"))
    result = run(problem, notice=notice)
    model = reduced(problem, problem.prior.mean)
    ranking = rank(model)
    decision = decide(ranking, result)
    best = None if decision.kind == NOTHING else leader(ranking)
    deck = extended(problem, best) if decision.kind == NAMED else None
    return Diagnosis(
        problem=problem,
        kind=decision.kind,
        result=result,
        innovation=result.innovation,
        explanations=explanations(ranking),
        groups=ranking.groups,
        noise_scale=ranking.noise_scale,
        law=None if best is None else implied_law(best),
        held_out=held_out(model, ranking.baseline, best),
        proposals=_proposals(ranking) if decision.kind == ONE_OF else (),
        extended=deck,
        extended_result=None if deck is None else run(deck, notice=notice),
    )


def leader(ranking: Ranking) -> Fit | None:
    """The most probable fit that has a cause."""
    return next((one for one in ranking.fits if one.recipes), None)


def _proposals(ranking: Ranking) -> tuple[Proposal, ...]:
    """What would separate the leading explanation from the best one of another group."""
    first = ranking.fits[0]
    second = next((one for one in ranking.fits if group(one) != group(first)), None)
    return () if second is None else proposals(first, second, (group(first), group(second)))
