"""How a run with frequency response functions begins: what of them is fitted, and how many modes that takes."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from mouse_cli.dynamics.eigen import EigenSolution
from mouse_cli.dynamics.frf_basis import BEYOND
from mouse_cli.model.arrays import Matrix, is_sparse
from mouse_cli.model.modal_test import ModalTest
from mouse_cli.model.problem import Problem
from mouse_cli.observables.frf import observe
from mouse_cli.updating.frf_gains import gains
from mouse_cli.updating.frf_state import FrfSetting

_FIRST_COUNT = 20  # modes that a search for the top of the band begins with


def with_test(problem: Problem) -> Problem:
    """The problem with a modal test of no mode, where it has FRFs alone."""
    if problem.test is not None or not problem.frf:
        return problem
    none = np.zeros(0)
    return replace(problem, test=ModalTest(none, none, none, none, np.zeros((0, 0)), np.zeros((0, 0))))


def begin(
    problem: Problem, K: Matrix, solve: Callable[[int | None], EigenSolution]
) -> tuple[FrfSetting | None, EigenSolution]:
    """The FRFs as they are fitted, None where there are none; and the solution of the prior model, solve(count).

    A sparse model is solved for every mode up to BEYOND times the highest line.
    """
    held = problem.held_records.frf if problem.held_records else ()
    if not problem.frf and not held:
        return None, solve(None)
    fitted, kept = (tuple(observe(test, test.form) for test in tests) for tests in (problem.frf, held))
    setting = FrfSetting(fitted, gains(problem, problem.frf + held), held=kept)
    if not is_sparse(K):
        return setting, solve(None)
    least = int(problem.test.number.max(initial=0)) + 6
    count, n = min(max(_FIRST_COUNT, least), K.shape[0]), K.shape[0]
    while True:
        solution = solve(count)
        if solution.complete or count >= n or solution.eigenvalues[-1] >= (BEYOND * setting.top) ** 2:
            return replace(setting, count=count), solution
        count = min(2 * count, n)
