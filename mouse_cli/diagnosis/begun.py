"""The model that a diagnosis begins with: on elements short enough for its test, and corrected for what their length still does.

Where half as long elements move a mode so far that a correction to first order leaves more than the test's own standard deviation,
members swing by themselves among the modes that were measured, and whatever is missing would be sought in a wrong model: the deck
is then taken on half as long elements.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from mouse_cli.diagnosis.extend.halves import halved
from mouse_cli.diagnosis.likelihoods.measured import Measured
from mouse_cli.diagnosis.likelihoods.modal.meshed import HALVINGS, meshed
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.localise.ties import ties
from mouse_cli.dynamics.solver import EigenSolver
from mouse_cli.model.problem import Problem, RunOptions
from mouse_cli.updating.prior_model import related


@dataclass(frozen=True)
class Begun:
    """measured: with the deck on elements short enough, `problem`; kept (m,): mask of the modes that have to do with its model.

    solver: that has its modes; model: reduced, at the prior mean; remarks: on elements that were halved, and that are corrected.
    """

    measured: Measured
    problem: Problem
    solver: EigenSolver
    kept: np.ndarray
    model: Reduced
    remarks: tuple[str, ...]


def begun(measured: Measured, notice: Callable[[str], None]) -> Begun:
    """What a diagnosis of what was `measured` begins with.

    Raises NumericalError where the model as it is has nothing to do with the test.
    """
    said: tuple[str, ...] = ()
    while True:
        problem = replace(measured.problem, run=_thorough(measured.problem.run))
        solver = EigenSolver(notice, sensors=0 if problem.test is None else problem.test.s)
        kept, found = related(problem, solver), meshed(problem, solver)
        if not found.coarse or len(said) == HALVINGS:
            return Begun(measured, problem, solver, kept, _with_ties(found.model), said + found.remarks)
        said += (found.said(problem),)
        measured = measured.of(halved)


def again(problem: Problem) -> Reduced:
    """The model that a diagnosis of `problem` searches with, made once more by another process."""
    solver = EigenSolver(lambda text: None, sensors=0 if problem.test is None else problem.test.s)
    related(problem, solver)
    return _with_ties(meshed(problem, solver).model)


def _with_ties(model: Reduced) -> Reduced:
    """The same, looked at for pairs of places."""
    return replace(model, ties=ties(model))


def _thorough(options: RunOptions) -> RunOptions:
    """The options of a deck, with the true posterior mode sought to the end: the prior is used once, however few cycles it asks."""
    usual = RunOptions()
    same = {
        name: getattr(usual, name)
        for name in ("estimator", "recursion", "passes", "cycles", "extra_update", "limit_sd")
    }
    return replace(options, partials=max(options.partials, usual.partials), **same)
