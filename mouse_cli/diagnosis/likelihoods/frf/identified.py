"""Modes of a deck that gives frequency response functions alone: causes are first sought by them."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from mouse_cli._errors import ERROR, DeckError, Diagnostic, NumericalError
from mouse_cli.model.frf_test import KINDS, FrfTest
from mouse_cli.model.identification import Modes, measured_test
from mouse_cli.model.modal_test import ModalTest, restricted
from mouse_cli.model.problem import Problem
from mouse_cli.records.identify import identify_frf
from mouse_cli.records.identify_combine import combined
from mouse_cli.updating.frf_mistakes import other_sign
from mouse_cli.updating.prior_model import related

_OPEN = 0.1  # of the functions near a mode: what its fit may leave
_DECIBELS = 400.0  # above which no magnitude is in decibels
_FEWEST = 4  # modes that functions must fit in another reading, where as read they fit hardly any


def with_modes(problem: Problem) -> tuple[Problem, tuple[str, ...]]:
    """`problem` with the modes that its FRFs show as its test, where it has no modes of its own; and what speaks against them.

    Raises NumericalError (MD680) when the functions show none.
    """
    if problem.test is not None or not problem.frf:
        return problem, ()
    found = identify_frf(problem.frf)
    _read_rightly(problem, found.modes)
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
    test = _test(problem, found.modes)
    kept = _strongest(found.modes, problem.structure.n)
    if not kept.all():
        hz = ", ".join(f"{value:.6g} Hz" for value in test.frequency_hz[~kept])
        doubts += (
            f"the model has {problem.structure.n} degrees of freedom: the weakest modes of the functions, at {hz}, are none of its",
        )
        test = restricted(test, kept)
        test = replace(test, number=np.arange(1, test.m + 1))
    return replace(problem, test=test), doubts


def _read_rightly(problem: Problem, modes: Modes) -> None:
    """Raise DeckError (MD456) where functions that fit hardly any modes fit many in another reading."""
    if modes.m and not np.nanmedian(modes.error) > _OPEN:
        return
    fitted = lambda found: int((found.error < _OPEN).sum())
    enough = max(_FEWEST, 3 * fitted(modes))
    fits = lambda other: fitted(other) >= enough
    if fits(_modes(problem, H=lambda test: test.H.conj())):
        raise DeckError(other_sign(problem))
    for kind in (each for each in KINDS if each != problem.frf[0].kind):
        if fits(found := _modes(problem, kind=lambda test, kind=kind: kind)):
            related(replace(problem, test=_test(problem, found)))
    largest = max(float(np.nanmax(np.abs(test.H), initial=0.0)) for test in problem.frf)
    raised = lambda test: 10 ** (np.abs(test.H) / 20) * np.exp(1j * np.angle(test.H))
    if largest < _DECIBELS and fits(_modes(problem, H=raised)):
        raise DeckError(
            _of_magnitudes(problem, fitted(modes), "read as decibels", "name the channels of magnitudes magnitude_db")
        )
    if fits(_modes(problem, H=lambda test: np.abs(test.H) * test.H)):
        help = "decibels of a function are 20 log10 of its magnitude: give twice those values, or magnitudes"
        raise DeckError(_of_magnitudes(problem, fitted(modes), "squared, as of decibels by 10 log10", help))


def _of_magnitudes(problem: Problem, count: int, said: str, help: str) -> Diagnostic:
    message = f"the functions fit {count} modes, and at least {max(_FEWEST, 3 * count)} with their magnitudes {said}"
    return Diagnostic("MD456", ERROR, message, problem.place("frf"), help=help)


def _modes(problem: Problem, **other: Callable[[FrfTest], object]) -> Modes:
    """The modes that the functions show in another reading."""
    read = [replace(test, **{key: of(test) for key, of in other.items()}) for test in problem.frf]
    return identify_frf(read).modes


def _test(problem: Problem, modes: Modes) -> ModalTest:
    """The modes as a test."""
    functions = combined(problem.frf)[0]
    return replace(measured_test(modes, functions.outputs, functions.output_names), held=functions.held)


def _strongest(modes: Modes, most: int) -> np.ndarray:
    """Mask (m,) of the `most` modes that respond most at their resonances, |shape|^2 / damping."""
    strength = (np.abs(modes.shapes) ** 2).sum(axis=0) / np.maximum(modes.damping, 1e-6)
    kept = np.zeros(modes.m, bool)
    kept[np.argsort(-strength)[:most]] = True
    return kept
