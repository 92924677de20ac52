"""Errors that only an eigensolution shows: a test that cannot belong to its model, a model that is not physical."""

from dataclasses import replace

import numpy as np

from mouse_cli._errors import ERROR, WARNING, DeckError, Diagnostic, NumericalError
from mouse_cli.dynamics.correlation import mac
from mouse_cli.dynamics.eigen import EigenSolution
from mouse_cli.model.problem import Problem
from mouse_cli.updating.state import reference_eigenvalue

_MOST_RIGID_1972 = 3


def check_rigid_modes(problem: Problem, solution: EigenSolution) -> None:
    """Raise DeckError when a rigid-body mode is named as measured: its accuracy would become a zero variance."""
    rigid = solution.rigid(reference_eigenvalue(problem, solution.eigenvalues))
    named = [int(n) for n in problem.test.number if n <= rigid]
    if named:
        least = f"{'at least ' if rigid == len(solution.eigenvalues) else ''}{rigid}"  # no flexural one was asked for
        raise DeckError.of(
            "MD330",
            f"mode {named[0]} is named as measured, but the model has {least} rigid-body mode(s) and this is one of them",
            problem.place(f"mode {named[0]}"),
            note=f"mode numbers count the rigid-body modes; the first flexural mode is number {rigid + 1}",
            help=f"add {least} to the mode numbers of the test; or give the supports, if the structure is held",
        )
    if problem.run.legacy and rigid > _MOST_RIGID_1972:
        message = f"the model has {rigid} rigid-body modes; the program of 1972 allowed {_MOST_RIGID_1972}"
        raise DeckError.of("MD332", message, problem.place("order"), help="run without --legacy")


def unknown_estimator(problem: Problem, reason: str) -> DeckError:
    """The error for a deck that asks for an estimator there is not."""
    help = "choose one of those that `mouse list estimators` shows"
    return DeckError.of("MD334", reason, problem.place("estimator"), help=help)


def no_test(problem: Problem) -> DeckError:
    """The error for a deck that states no test, and so nothing to revise the model by."""
    message = f"the deck '{problem.title.strip()}' holds no test: there is nothing to revise the model by"
    help = "add `test:` with measured modes or functions, or use `mouse modes`"
    if problem.recordings:
        message = f"the test of '{problem.title.strip()}' holds recordings alone, and neither modes nor functions"
        help = "`mouse run` revises by recordings; `mouse identify` makes modes of them, `mouse spectra` functions"
    return DeckError.of("MD333", message, problem.place("test"), help=help)


def unphysical(problem: Problem, reason: str) -> NumericalError:
    """The error for a prior model that has no real natural frequencies."""
    return NumericalError(
        Diagnostic(
            "MD501",
            ERROR,
            f"the prior model of '{problem.title.strip()}' is not physical: {reason}",
            problem.place("order"),
            help="check the signs of the off-diagonal stiffnesses and that every mass is positive",
        )
    )


def unrelated(problem: Problem, solution: EigenSolution, mode: int, ratio: float) -> DeckError:
    """The error for a test vector that has nothing in common with the mode it is said to be."""
    test = problem.test
    likeness = mac(test.shapes[:, [mode]], test.read(solution.shapes))[0]
    best = int(np.argmax(likeness))
    return DeckError.of(
        "MD331",
        f"the shape measured for mode {test.number[mode]} is unrelated to that of the mode of the model that it is "
        f"paired with: |c t| / |x| is {ratio:.3g}, at least 0.1 is expected",
        problem.place(f"mode {test.number[mode]}"),
        note=f"it looks most like model mode {best + 1} (MAC {likeness[best]:.2f})",
        help="check the mode numbers and the order of the measured points; if these are right, the model lacks what makes this "
        "mode: `mouse diagnose`",
    )


def left_out(error: DeckError) -> tuple[Diagnostic, ...]:
    """What `mouse run` refuses of a test of which most modes are the model's, and `mouse diagnose` does not."""
    return tuple(replace(one, severity=WARNING, message=f"{one.message}; `mouse run` refuses it") for one in error.diagnostics)


def not_simulated(problem: Problem) -> NumericalError:
    """The error for a model whose simulation under the measured force does not stay finite."""
    message = f"the model of '{problem.title.strip()}' does not stay finite under the measured force"
    help = "check the sizes of its laws, and the units of the force channels"
    return NumericalError(Diagnostic("MD540", ERROR, message, problem.place("recordings"), help=help))
