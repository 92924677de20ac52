"""The model that a diagnosis begins with: on elements short enough for its test, and corrected for what their length still does.

Where half as long elements move a mode so far that a correction to first order leaves more than the test's own standard deviation,
members swing by themselves among the modes that were measured, and whatever is missing would be sought in a wrong model: the deck
is then taken on half as long elements.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from mouse_cli.diagnosis.extend.halves import beyond, halved
from mouse_cli.diagnosis.likelihoods.measured import Measured
from mouse_cli.diagnosis.likelihoods.modal.baseline import reduced
from mouse_cli.diagnosis.likelihoods.modal.model import Model
from mouse_cli.diagnosis.likelihoods.modal.numerics import numerics
from mouse_cli.diagnosis.likelihoods.modal.point import Point
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.localise.ties import ties
from mouse_cli.dynamics.solver import EigenSolver
from mouse_cli.model.problem import Problem, RunOptions
from mouse_cli.updating.prior_model import related

_HALVINGS = 2  # of elements at most


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
        kept = related(problem, solver)
        model, remarks, coarse = _modelled(problem, solver)
        if not coarse or len(said) == _HALVINGS:
            return Begun(measured, problem, solver, kept, model, said + remarks)
        said += (
            f"numerics: the mesh is too coarse for this test, {coarse}: every beam is taken in two halves (cables in four), the "
            f"second of which, and the node between, are called {beyond(problem)} more than the element",
        )
        measured = measured.of(halved)


def again(problem: Problem) -> Reduced:
    """The model that a diagnosis of `problem` searches with, made once more by another process."""
    solver = EigenSolver(lambda text: None, sensors=0 if problem.test is None else problem.test.s)
    related(problem, solver)
    return _modelled(problem, solver)[0]


def _thorough(options: RunOptions) -> RunOptions:
    """The options of a deck, with the true posterior mode sought to the end: the prior is used once, however few cycles it asks."""
    usual = RunOptions()
    same = {
        name: getattr(usual, name)
        for name in ("estimator", "recursion", "passes", "cycles", "extra_update", "limit_sd")
    }
    return replace(options, partials=max(options.partials, usual.partials), **same)


def _modelled(problem: Problem, solver: EigenSolver) -> tuple[Reduced, tuple[str, ...], str]:
    """The reduced model at the prior mean, corrected for its mesh, its data allowed what that leaves; what to say of it, and of a
    mesh that is too coarse.

    Functions are of the matrices as they are, so that a model of these is not corrected, and is too coarse sooner.
    """
    model = reduced(problem, problem.prior.mean, solver)
    bare = Model(model).point(model.z)
    if bare is None:
        return model, (), ""
    found = numerics(problem, problem.prior.mean, *_looked_at(model, bare))
    found = replace(found, finer=None) if problem.frf else found
    mesh, still = found.allowed(model, bare), np.zeros(model.data.has_shape.shape)
    model = replace(model, finer=found.finer, mesh=mesh, data=model.data.loosened(mesh[bare.modes], still))
    return replace(model, ties=ties(model)), found.remarks, found.coarse(mesh)


def _looked_at(model: Reduced, bare: Point) -> tuple[np.ndarray, np.ndarray]:
    """Numbers (n,) from 0 of the modes that were fitted or are held out, and the least sd (n,) of their ln f."""
    least = dict(zip(bare.modes.tolist(), model.data.sd_log.tolist(), strict=True))
    held = model.problem.hold_out
    for test in [] if held is None else [each for each in (held.test, *held.altered) if each is not None]:
        sd = (test.frequency_sd_hz / test.frequency_hz).tolist()
        for number, own in zip((test.number - 1).tolist(), sd, strict=True):
            if number < model.r and own == own:
                least[number] = min(own, least.get(number, own))
    return np.array(sorted(least), int), np.array([least[number] for number in sorted(least)])
