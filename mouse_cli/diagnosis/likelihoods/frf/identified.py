"""Modes of a deck that gives frequency response functions alone: causes are first sought by them."""

from dataclasses import replace

import numpy as np

from mouse_cli._errors import ERROR, Diagnostic, NumericalError
from mouse_cli.model.identification import Modes, measured_test
from mouse_cli.model.modal_test import restricted
from mouse_cli.model.problem import Problem
from mouse_cli.records.identify import identify_frf
from mouse_cli.records.identify_combine import combined


def with_modes(problem: Problem) -> tuple[Problem, tuple[str, ...]]:
    """`problem` with the modes that its FRFs show as its test, where it has no modes of its own; and what speaks against them.

    Raises NumericalError (MD680) when the functions show none.
    """
    if problem.test is not None or not problem.frf:
        return problem, ()
    found = identify_frf(problem.frf)
    if not found.modes.m:
        said = "; ".join(each.message for each in found.doubts) or "no pole is stable"
        raise NumericalError(
            Diagnostic(
                "MD680",
                ERROR,
                f"the frequency response functions show no mode: {said}",
                problem.place("frf"),
                help="see `mouse identify` on this deck; or give measured modes beside the functions: test.modes",
            )
        )
    doubts = tuple(f"modes of the functions: {each.message}" for each in found.doubts)
    functions = combined(problem.frf)[0]
    test = replace(measured_test(found.modes, functions.outputs, functions.output_names), held=functions.held)
    kept = _strongest(found.modes, problem.structure.n)
    if not kept.all():
        hz = ", ".join(f"{value:.6g} Hz" for value in test.frequency_hz[~kept])
        doubts += (
            f"the model has {problem.structure.n} degrees of freedom: the weakest modes of the functions, at {hz}, are none of its",
        )
        test = restricted(test, kept)
        test = replace(test, number=np.arange(1, test.m + 1))
    return replace(problem, test=test), doubts


def _strongest(modes: Modes, most: int) -> np.ndarray:
    """Mask (m,) of the `most` modes that respond most at their resonances, |shape|^2 / damping."""
    strength = (np.abs(modes.shapes) ** 2).sum(axis=0) / np.maximum(modes.damping, 1e-6)
    kept = np.zeros(modes.m, bool)
    kept[np.argsort(-strength)[:most]] = True
    return kept
