"""Diagnosis by recordings: is it linear, where does it depart, which law, how much, and is it true."""

from collections.abc import Callable
from dataclasses import replace

from mouse_cli.diagnosis.extend.laws import extended
from mouse_cli.diagnosis.likelihoods.history.search import weighed
from mouse_cli.diagnosis.likelihoods.history.verdict import Decision, decided, explanations, ranked, remedies, untried
from mouse_cli.diagnosis.search.rank import Ranking
from mouse_cli.diagnosis.verdict import leader
from mouse_cli.model.diagnosis import NAMED, NOTHING, ONE_OF, UNKNOWN, Choices, Diagnosis
from mouse_cli.model.problem import Problem
from mouse_cli.model.record_diagnosis import RecordDiagnosis
from mouse_cli.model.result import ChiSquareTest
from mouse_cli.terms.laws import registry
from mouse_cli.updating.chi_square import upper_tail
from mouse_cli.updating.recordings.at_odds import odd
from mouse_cli.updating.recordings.channels import misreadings
from mouse_cli.updating.recordings.fit import Fit
from mouse_cli.updating.recordings.noise import freely
from mouse_cli.updating.recordings.records import named, records
from mouse_cli.updating.recordings.regression import Regression
from mouse_cli.updating.recordings.signs import linearity
from mouse_cli.updating.recordings.study import Study, finer, study
from mouse_cli.updating.recordings.validation import ratio, scores, surface, trace

_THERE = 0.5  # share of what a law leaves that any law of the motion or the velocity there takes, from which on it is of the law

Notice = Callable[[str], None]


def diagnose_records(problem: Problem, notice: Notice, choices: Choices, own: Study | None = None) -> Diagnosis:
    """What the model of `problem` lacks, judged by its recordings; own: what their fits share, where modes judged first.

    Raises DeckError (MD640) for records that cannot judge.
    """
    own = study(problem, records(problem)) if own is None else own
    found = own.records
    every = registry() | misreadings(own.look.dt)
    known = None if choices.candidates is None else [law for key, law in every.items() if key in choices.candidates]
    searched = weighed(own, notice, known, choices.causes)
    baseline, ranking = searched.baseline, _finer(own, ranked(searched))
    notice("records that no fit has seen")
    best = leader(ranking)
    proof = scores(own, baseline, best)
    decision = _with_shape(own, best, decided(ranking, searched, ratio(proof), own.look.free, known is None))
    kind = decision.kind
    told = best if kind in (NAMED, ONE_OF) else None
    cautions = decision.cautions + remedies(told if decision.rest is None else None, own)
    cautions += (searched.otherwise,) if searched.otherwise else _strange(own, best or baseline, kind)
    dof = max(int(baseline.dof), 1)
    return RecordDiagnosis(
        problem=problem,
        result=None,
        innovation=ChiSquareTest("residual", baseline.misfit, dof, upper_tail(baseline.misfit, dof)),
        explanations=explanations(ranking, own),
        groups=ranking.groups,
        noise_scale=ranking.noise_scale,
        **vars(decision) | {"cautions": cautions},
        untried=untried(searched, own, known),
        remarks=found.remarks + own.model.remarks + (best or baseline).calibrated,
        choices=choices,
        **named(found),
        linearity=linearity(own, baseline),
        scores=proof,
        trace=trace(own, baseline, best if kind != NOTHING else None),
        noise=searched.noise,
        outside=bool(searched.otherwise) and not searched.fits and kind == UNKNOWN,
        surface=None if told is None else surface(own, told),
        extended=None if told is None else extended(problem, told),
    )


def _with_shape(own: Study, best: Fit | None, decision: Decision) -> Decision:
    """The same, and whether what remains follows from the motion where the law is."""
    if decision.rest is None or best is None:
        return decision
    at = Regression(own.spectrum, best.hypothesis.placed(best.hypothesis.parts[0].place), best.x)
    return replace(decision, rest=replace(decision.rest, there=freely(at) > _THERE))


def _strange(own: Study, one: Fit, kind: str) -> tuple[str, ...]:
    """That one recording is at odds with the others, where none of it has a name."""
    found = odd(one, own.data) if kind == UNKNOWN else None
    return () if found is None else (found.said(own.records.outputs),)


def _finer(own: Study, found: Ranking) -> Ranking:
    """The ranking with the sizes of its leading law from shorter steps."""
    best = leader(found)
    if best is None:
        return found
    settled = finer(own, best)
    return replace(found, fits=tuple(settled if one is best else one for one in found.fits))
