"""Locate, name, model, prove: the whole of a diagnosis."""

from collections.abc import Callable
from dataclasses import replace

from mouse_cli.diagnosis.decide import decide, explanations
from mouse_cli.diagnosis.name import rank
from mouse_cli.diagnosis.reduced import reduced
from mouse_cli.model.diagnosis import Diagnosis
from mouse_cli.model.problem import Problem
from mouse_cli.updating.loop import run

Notice = Callable[[str], None]


def diagnose(problem: Problem, notice: Notice = lambda text: None) -> Diagnosis:
    """What the model of `problem` lacks, judged by its test.

    Raises DeckError and NumericalError as `run` does.
    """
    problem = replace(problem, run=replace(problem.run, recursion="anchored", estimator="bayes"))
    result = run(problem, notice=notice)
    model = reduced(problem, result.revised.theta)
    ranking = rank(model)
    decision = decide(ranking)
    return Diagnosis(
        problem=problem,
        kind=decision.kind,
        result=result,
        innovation=result.innovation,
        explanations=explanations(ranking),
        groups=ranking.groups,
        noise_scale=ranking.noise_scale,
    )
