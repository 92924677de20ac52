"""Errors of methods of updating: what a deck lacks for one, a model that is too large, an answer that is not determined."""

import numpy as np

from mouse_cli._errors import ERROR, DeckError, Diagnostic, NumericalError
from mouse_cli.model.modal_test import ModalTest
from mouse_cli.model.problem import Problem

MOST_DENSE = 2000  # degrees of freedom up to which K is made full


def without_shape(problem: Problem, key: str, test: ModalTest) -> DeckError | None:
    """The error for modes of which no shape, or no frequency, was measured; None where all have both."""
    have = np.isfinite(test.shapes).any(axis=0) & np.isfinite(test.frequency_hz)
    if have.all() and test.m:
        return None
    number = int(test.number[~have][0]) if test.m else 0
    message = f"'{key}' is made of frequencies and shapes, but mode {number} of the test has only one of the two"
    help = "give both, hold the mode out (test.hold_out.modes), or take a method that fits frequencies alone"
    return DeckError.of("MD560", message, problem.place(f"mode {number}"), help=help)


def too_large(problem: Problem, key: str) -> NumericalError:
    """The error for a model whose K would be full."""
    n = problem.structure.n
    message = (
        f"'{key}' would make a full stiffness matrix of {n} degrees of freedom, {8e-9 * n * n:.3g} GB; at most {MOST_DENSE} "
        "are treated so"
    )
    help = (
        "reduce the model, or take a method that revises properties: generic, equation-error, inverse-eigensensitivity"
    )
    return NumericalError(Diagnostic("MD561", ERROR, message, problem.place("order"), help=help))


def lacking(problem: Problem, key: str, what: str, help: str) -> DeckError:
    """The error for a deck without something that the method `key` cannot do without."""
    return DeckError.of("MD566", f"'{key}' needs {what}", problem.place("order"), help=help)


def not_expanded(problem: Problem, how: str, reason: str) -> NumericalError:
    """The error for shapes that an expansion cannot carry to all degrees of freedom."""
    message = f"the shapes measured for '{problem.title.strip()}' cannot be expanded by {how}: {reason}"
    help = "choose another of `mouse list expansions` by --expand, or measure at more points"
    return NumericalError(Diagnostic("MD514", ERROR, message, problem.place("order"), help=help))


def no_answer(problem: Problem, key: str, reason: str) -> NumericalError:
    """The error for numbers of which the method makes no matrices."""
    message = f"'{key}' finds no answer: {reason}"
    help = "see whether the values of the deck span too many powers of ten, or modes are measured as zero"
    return NumericalError(Diagnostic("MD570", ERROR, message, problem.place("order"), help=help))


def alike(problem: Problem) -> NumericalError:
    """The error for shapes that are dependent once they are expanded and freed of rigid motion."""
    message = "the measured shapes, expanded, are no independent shapes of an elastic structure"
    help = "measure at points that separate the modes: `mouse correlate` shows which are alike"
    return NumericalError(Diagnostic("MD516", ERROR, message, problem.place("order"), help=help))


def undetermined(problem: Problem, key: str, names: list[str], reason: str) -> NumericalError:
    """The error for properties that the equations leave open."""
    message = f"'{key}' does not determine {', '.join(names[:6])}: {reason}"
    help = "tie like elements together, measure more modes, or hold some of the properties"
    return NumericalError(Diagnostic("MD567", ERROR, message, problem.place("order"), help=help))
