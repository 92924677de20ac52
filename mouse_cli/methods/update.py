"""One deck, one method: what the method needs, its answer, what becomes of its guarantees, predictions, and remarks."""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from mouse_cli._errors import WARNING, Diagnostic, MouseError
from mouse_cli.dynamics.eigen import IndefiniteError
from mouse_cli.dynamics.solver import Notice
from mouse_cli.methods import ELEMENTS, FUNCTIONS, PARAMETERS, SHAPES, Method, method, refusals, registry
from mouse_cli.methods.found import Found
from mouse_cli.methods.given import Given
from mouse_cli.methods.predicted import Modes, as_test, changed, modes, predicted
from mouse_cli.model.arrays import Matrix, dense, is_sparse
from mouse_cli.model.problem import Problem
from mouse_cli.model.updated import Checked, Compared, Predicted, Updated
from mouse_cli.terms.assembly import assembly as assemble
from mouse_cli.updating import mistakes
from mouse_cli.updating import refusals as deck_refusals
from mouse_cli.updating.state import reference_eigenvalue, solve

EXPANSION = "residual-energy"
_ZERO = 1e-12  # of the root of the product of diagonals: an element that is none


def update(problem: Problem, key: str, how: str = EXPANSION, notice: Notice = lambda text: None) -> Updated:
    """The answer of the method `key` to `problem`; how: the expansion of shapes. notice: as for `run`.

    Raises ValueError for an unknown method, DeckError for a deck that lacks what it needs, NumericalError without an answer.
    """
    chosen = method(key)
    given = _given(problem, chosen, how, notice)
    notice(f"{chosen.title}: updating")
    try:
        return _judged(given, chosen, chosen.update(given))
    except np.linalg.LinAlgError as reason:
        raise refusals.no_answer(problem, key, str(reason)) from None


def compare(
    problem: Problem, keys: tuple[str, ...] = (), how: str = EXPANSION, notice: Notice = lambda text: None
) -> Compared:
    """The answers of the methods `keys` (none: of all) to `problem`; a method that the deck does not serve is told with its reason.

    Raises ValueError for an unknown method, DeckError where no method has an answer.

    >>> import mouse_cli
    >>> found = mouse_cli.compare(mouse_cli.read_deck("decks/table_5_2.yaml"))
    >>> [each.about.key for each in found.updates][:3], list(found.refused)
    (['baruch', 'berman', 'equation-error'], ['generic', 'response-function'])
    """
    answers, refused = [], {}
    for key in keys or tuple(registry()):
        try:
            answers.append(update(problem, key, how, notice))
        except MouseError as reason:
            refused[key] = reason.diagnostics
            first = reason
    if not answers:
        raise first
    return Compared(problem, tuple(answers), refused)


def _given(problem: Problem, chosen: Method, how: str, notice: Notice) -> Given:
    """What the method starts from. Raises DeckError and NumericalError."""
    key = chosen.key
    if FUNCTIONS in chosen.needs and not problem.frf:
        raise refusals.lacking(problem, key, "measured frequency response functions", "give test.frf")
    if problem.test is None and not problem.frf:
        raise deck_refusals.no_test(problem)
    if problem.test is None and FUNCTIONS not in chosen.needs:
        raise refusals.lacking(problem, key, "measured modes", "give test.modes, or identify them by `mouse identify`")
    if PARAMETERS in chosen.needs and not any(p.sd > 0 for p in problem.parameters):
        raise refusals.lacking(problem, key, "parameters that may vary", "give parameters with an sd")
    if ELEMENTS in chosen.needs and problem.mesh is None:
        raise refusals.lacking(problem, key, "a structure of elements", "describe the model by model.structure")
    if SHAPES in chosen.needs:
        refused = refusals.without_shape(problem, key, problem.test)
        if refused is not None:
            raise refused
    if chosen.dense and problem.structure.n > refusals.MOST_DENSE:
        raise refusals.too_large(problem, key)
    return _begun(problem, chosen.dense, how, notice)


def _begun(problem: Problem, full: bool, how: str, notice: Notice) -> Given:
    """The prior model solved; full: with dense matrices."""
    assembly = assemble(problem)
    K, M = assembly.matrices(problem.prior.mean)
    if full:
        K, M = dense(K), dense(M)
    try:
        solution = solve(problem, K, M)
    except (IndefiniteError, np.linalg.LinAlgError) as reason:
        raise deck_refusals.unphysical(problem, str(reason)) from None
    if problem.test is not None:
        mistakes.check(problem, solution)
        deck_refusals.check_rigid_modes(problem, solution)
    r = solution.rigid(reference_eigenvalue(problem, solution.eigenvalues))
    return Given(problem, assembly, K, M, solution, r, how, notice)


def _judged(given: Given, chosen: Method, found: Found) -> Updated:
    """The answer with what it comes to."""
    problem, numbers = given.problem, [0]
    for test in (problem.test, problem.hold_out and problem.hold_out.test):
        numbers += [] if test is None else test.number.tolist()
    prior = modes(problem, given.K, given.M, max(numbers))
    revised = modes(problem, found.K, found.M, max(numbers))
    answer = Updated(
        problem=problem,
        about=chosen.about,
        expansion=given.how if SHAPES in chosen.needs else "",
        configurations=tuple(_configurations(given, found, prior, revised)),
        checked=_checked(given, chosen, found, prior, revised),
        **vars(found),
    )
    return replace(answer, warnings=tuple(remarks(answer)))


def _configurations(given: Given, found: Found, prior: Modes, revised: Modes) -> list[Predicted]:
    """Fitted modes, modes held out, altered structures."""
    problem, predictions = given.problem, []
    held = problem.hold_out
    if problem.test is not None:
        predictions.append(predicted(problem, "fitted", True, problem.test, prior, revised))
    if held is not None and held.test is not None:
        predictions.append(predicted(problem, "held out", False, held.test, prior, revised))
    for altered in held.altered if held is not None else ():
        highest = int(altered.number.max())
        sides = [modes(problem, *changed(*pair, altered), highest) for pair in ((given.K, given.M), (found.K, found.M))]
        predictions.append(predicted(problem, altered.title, False, as_test(problem, altered), *sides))
    return predictions


def _checked(given: Given, chosen: Method, found: Found, prior: Modes, revised: Modes) -> Checked:
    """What became of the guarantees."""
    filled, stored = _filled(given, found.K)
    lowest = float(revised.eigenvalues[0])
    return Checked(
        misfit=_misfit(given, found) if SHAPES in chosen.needs else float("nan"),
        lowest_hz=float(np.sign(lowest) * np.sqrt(abs(lowest)) / (2 * np.pi)),
        negative=revised.negative,
        rigid=revised.rigid,
        rigid_before=prior.rigid,
        filled=filled,
        stored=stored,
    )


def _misfit(given: Given, found: Found) -> float:
    """Largest |(K - lambda M) x| / |lambda M x| of the measured modes, expanded by the updated model, by energies."""
    try:
        X = given.orthonormal(given.expanded(found.K))
    except MouseError:
        return float("nan")
    inertia = (found.M @ X) * given.eigenvalues
    left, energy_of = found.K @ X - inertia, given.energies()
    parts = [np.einsum("ij,ij->j", forces, energy_of(forces)) for forces in (left, inertia)]
    return float(np.sqrt(np.maximum(parts[0], 0.0) / parts[1]).max())


def _filled(given: Given, after: Matrix) -> tuple[int, int]:
    """Elements of K outside of the pattern that the model has, and how many are within."""
    if is_sparse(after):
        return 0, int(after.nnz)  # over the pattern of the elements
    before, root = dense(given.K), np.sqrt(np.abs(np.diag(dense(given.K))))
    had = np.abs(before) > _ZERO * np.outer(root, root)
    for term in given.assembly.terms:
        if "K" in term.places:
            had[term.places["K"].row, term.places["K"].col] = True
    has = np.abs(after) > _ZERO * np.outer(root, root)
    return int((has & ~had).sum()), int(had.sum())


_SDS, _PERCENT = 3.0, 1.0


def remarks(found: Updated) -> Iterator[Diagnostic]:
    """Warnings, the gravest first."""
    about, checked = found.about, found.checked
    if not about.physical:
        text = f"'{about.key}' reproduces the data without a physical model"
        yield _warning("MD562", text, "trust it for the fitted modes alone; `mouse compare` shows its predictive error")
    if checked.negative:
        text = (
            f"the updated stiffness has {checked.negative} negative eigenvalue(s), down to {-checked.lowest_hz:.5g}i Hz"
        )
        yield _warning("MD563", text, "no structure has such a stiffness: take another method")
    if checked.rigid < checked.rigid_before:
        text = f"of {checked.rigid_before} rigid-body modes {checked.rigid} are left after the update"
        yield _warning(
            "MD564", text, "the method has tied the structure to the ground: take one that keeps rigid-body modes"
        )
    if not found.converged:
        text = f"the update still changes by {found.change:.2g} after {found.iterations} iterations"
        yield _warning("MD565", text, "tie like elements together, or give better shapes")
    if found.against:
        yield _warning("MD568", found.against, "`mouse diagnose` looks for missing physics")
    for one in found.configurations:
        yield from _missed(one)


def _missed(one: Predicted) -> Iterator[Diagnostic]:
    """Frequencies that are off by more than their accuracy."""
    with np.errstate(invalid="ignore"):
        off = one.revised_hz / one.test_hz - 1
        large = np.abs(one.revised_hz - one.test_hz) > _SDS * one.test_sd_hz
        if not one.fitted:
            large &= np.abs(off) > _PERCENT / 100
    large = (large | np.isnan(one.revised_hz)) & np.isfinite(one.test_hz)
    if not large.any():
        return
    worst = int(np.nanargmax(np.where(large, np.nan_to_num(np.abs(off), nan=np.inf), -1.0)))
    there = f"{one.revised_hz[worst]:.5g} Hz" if np.isfinite(one.revised_hz[worst]) else "no such mode"
    text = f"mode {one.number[worst]} ({one.title}) was measured at {one.test_hz[worst]:.5g} Hz, the updated model has {there}"
    if one.fitted:
        yield _warning("MD568", text, "what the method may move does not explain the data")
    else:
        yield _warning("MD569", text, "do not use the model beyond the fitted modes")


def _warning(code: str, text: str, help: str) -> Diagnostic:
    return Diagnostic(code, WARNING, text, help=help)
