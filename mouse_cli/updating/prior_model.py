"""The prior model before the first cycle: its eigensolution, the test brought to its scale, and what is wrong with either."""

from dataclasses import replace

import numpy as np

from mouse_cli._errors import DeckError, Diagnostic
from mouse_cli.dynamics.eigen import IndefiniteError
from mouse_cli.dynamics.solver import EigenSolver, Notice
from mouse_cli.estimators import estimator as find_estimator
from mouse_cli.estimators.linear import Estimator
from mouse_cli.model.arrays import is_sparse
from mouse_cli.model.modal_test import restricted
from mouse_cli.model.problem import Problem
from mouse_cli.observables.modal import UnrelatedShapes, observe
from mouse_cli.terms.assembly import assembly as assemble
from mouse_cli.terms.modal_damping import with_modal_damping
from mouse_cli.updating import frf_mistakes, mistakes, refusals, shape_mistakes
from mouse_cli.updating.coordinates import coordinates
from mouse_cli.updating.frf_gains import with_gains
from mouse_cli.updating.frf_setting import begin as begin_frf
from mouse_cli.updating.frf_setting import with_test
from mouse_cli.updating.state import Setting, State, paired, solve

_RELATED = 0.5  # share of the modes of a test up to which it is taken for another one, or for one out of order


def begin(
    problem: Problem, notice: Notice = lambda text: None, solver: EigenSolver | None = None
) -> tuple[Setting, State]:
    """O-1 for the prior model, and the test brought to its scale."""
    problem = with_gains(with_modal_damping(with_test(problem)))
    if problem.test is None:
        raise refusals.no_test(problem)
    assembly = assemble(problem)
    K, M = assembly.matrices(problem.prior.mean)
    solver = EigenSolver(notice, sensors=problem.test.s) if solver is None else solver
    try:
        frf, solution = begin_frf(problem, K, lambda count: solve(problem, K, M, count, solver, verify=True))
    except IndefiniteError as reason:
        raise refusals.unphysical(problem, str(reason)) from None
    mistakes.check(problem, solution)
    refusals.check_rigid_modes(problem, solution)
    shape_mistakes.check(problem, solution)
    modes = paired(problem, solution)
    try:
        observable = observe(problem.test, M, solution, modes)
    except UnrelatedShapes as reason:
        raise refusals.unrelated(problem, solution, reason.mode, reason.ratio) from None
    y, sd = observable.measured()
    if frf is not None:
        y, sd = (np.concatenate(pair) for pair in zip((y, sd), frf.data(), strict=True))
    setting = Setting(problem, assembly, coordinates(problem, assembly), observable, y, sd, solver, frf)
    return setting, State(setting, setting.coordinates.mean, solution)


def estimator(problem: Problem) -> Estimator:
    """The one that the deck asks for. Raises DeckError."""
    try:
        return find_estimator(problem.run.estimator)
    except ValueError as reason:
        raise refusals.unknown_estimator(problem, str(reason)) from None


def related(problem: Problem, solver: EigenSolver | None = None) -> np.ndarray:
    """Mask (m,) of the measured modes whose shapes have anything to do with the modes of the prior model they are paired with.

    Raises DeckError without a test, NumericalError without an eigensolution, as `run` does.
    """
    if problem.test is None:
        raise refusals.no_test(problem)
    K, M = assemble(problem).matrices(problem.prior.mean)
    try:
        solution = solve(problem, K, M, solver=solver)
    except (IndefiniteError, np.linalg.LinAlgError) as reason:
        raise refusals.unphysical(problem, str(reason)) from None
    mistakes.check(problem, solution)
    shape_mistakes.check(problem, solution)
    frf_mistakes.check(problem, solution)
    kept = np.ones(problem.test.m, bool)
    while kept.any():
        own = replace(problem, test=restricted(problem.test, kept))
        try:
            observe(own.test, M, solution, paired(own, solution))  # without one, others may be paired otherwise
            return kept
        except UnrelatedShapes as reason:
            kept[np.flatnonzero(kept)[reason.mode]] = False
    return kept


def examine(problem: Problem) -> tuple[Diagnostic, ...]:
    """What only the eigensolution of the prior model can tell of a deck; large models are left alone.

    Where few of the measured modes are none of the model's, that is a warning: a diagnosis goes without their shapes. Raises
    DeckError and NumericalError as `run` does before its first cycle.
    """
    estimator(problem)
    if is_sparse(problem.structure.K) or is_sparse(problem.structure.M):
        return ()
    try:
        if problem.test is None:
            solve(problem, *assemble(problem).matrices(problem.prior.mean))
        else:
            begin(problem)
    except (IndefiniteError, np.linalg.LinAlgError) as reason:
        raise refusals.unphysical(problem, str(reason)) from None
    except DeckError as error:
        if any(one.code != "MD331" for one in error.diagnostics) or related(problem).mean() <= _RELATED:
            raise
        return refusals.left_out(error)
    return ()
