"""The functions of the leading explanation, and of the model as it is, beside those that were fitted and those held out.

Both are computed at all lines, their standard deviations from the covariance of all that was estimated, to first order.
"""

from dataclasses import dataclass, replace

import numpy as np

from mouse_cli.diagnosis.likelihoods.frf.damping import damping
from mouse_cli.diagnosis.likelihoods.frf.data import FrfData, Lines, lines
from mouse_cli.diagnosis.likelihoods.frf.model import FrfModel
from mouse_cli.diagnosis.search.fit import Fit
from mouse_cli.diagnosis.search.rank import Ranking
from mouse_cli.model.block_window import BlockWindow
from mouse_cli.model.frf_fit import Damping, FrfFit, Modelled
from mouse_cli.model.frf_test import FORMS, FrfTest
from mouse_cli.model.problem import Problem
from mouse_cli.observables.frf import accuracy, names, usable
from mouse_cli.observables.frf_leakage import of_window

_MOST = 40_000_000  # derivatives of all functions at all lines by all unknowns, above which bands are left out
_LINES = 256  # worked on at once
_TOLD = 0.4  # standard deviation over value below which functions tell an amount of damping from none
_KINDS = (
    ("loss factor", "structural damping, of all stiffness", "1"),
    ("damping by mass", "viscous damping over mass", "1/s"),
    ("damping by stiffness", "viscous damping over stiffness", "s"),
    ("damping ratio", "viscous damping, of the same ratio in all modes", "1"),
)
Tests = tuple[FrfTest, ...]


@dataclass(frozen=True)
class Compared:
    """Fields of a Diagnosis. frf, held_frf: one a measurement; damping: of the structure, as that explanation has it."""

    frf: tuple[FrfFit, ...] = ()
    held_frf: tuple[FrfFit, ...] = ()
    damping: tuple[Damping, ...] = ()


def compared(problem: Problem, ranking: Ranking, best: Fit | None) -> Compared:
    """The model as it is, and with the causes of `best` where there are any, beside the functions of the test."""
    fitted, held = problem.frf, () if problem.held_records is None else problem.held_records.frf
    if not fitted and not held:
        return Compared()
    found = [("baseline", "model as it is", of_functions(ranking.baseline))]
    if inferred := window_of(found[0][2]):
        fitted, held = (
            tuple(replace(each, window=each.window or inferred) for each in tests) for tests in (fitted, held)
        )
    if best is not None:
        title = " and ".join(recipe.candidate.title for recipe in best.recipes)
        found.append(("revised", f"with {title}", of_functions(best)))
    if not all(isinstance(one.model, FrfModel) for _, _, one in found):
        known = [(key, name, _by_modes(one, held)) for key, name, one in found]
        return Compared(held_frf=_beside(held, known, held))
    chosen = tuple(np.flatnonzero(np.isin(test.laplace, lines(test, problem.theory).s)) for test in fitted)
    fits = tuple(replace(one, lines=own) for one, own in zip(_beside(fitted, found, fitted), chosen, strict=True))
    return Compared(fits, _beside(held, found, fitted), found_damping(found[-1][2]))


def window_of(one: Fit) -> BlockWindow | None:
    """The window that a fit of functions found where the deck states none; None: there is none."""
    if not isinstance(one.model, FrfModel):
        return None
    stated = {test.title: test.window for test in one.model.base.problem.frf}
    tests = [block.test for block in one.model.base.data.blocks]
    return next((test.window for test in tests if test.window and stated[test.title] is None), None)


def remarks(ranking: Ranking) -> tuple[str, ...]:
    """What to say of windows that no deck states, and of functions that scatter more than it does."""
    one = of_functions(ranking.baseline)
    found, more = window_of(one), _scatters(one)
    said = []
    if found is not None:
        said.append(
            f"the FRFs are explained as H1 of blocks of {found.seconds:.4g} s under a window '{found.name}', which the deck does "
            f"not state: check it, and give window: {found.name}"
        )
    if more > 1:
        said.append(
            f"the FRFs scatter {more:.2g} times as much as the deck states, from line to line, as noise does and physics does not: "
            "that is taken for their accuracy; give it, or average more"
        )
    return tuple(said)


def _scatters(one: Fit) -> float:
    """By what the standard deviations that a deck states were multiplied; 1 where none was, or nothing was stated."""
    data = one.model.base.data
    return float(np.sqrt(data.scale)) if isinstance(one.model, FrfModel) and not data.assumed else 1.0


def of_functions(one: Fit) -> Fit:
    """The fit of functions that stands behind a fit, itself where there is none."""
    found = getattr(one, "frf", None)
    return one if found is None else found


def _by_modes(one: Fit, tests: Tests) -> Fit:
    """A fit of modes with what functions need besides, as it is held likely: damping of the structure, gains and delays."""
    own, data = one.model.k, FrfData(tuple(lines(test, one.model.base.problem.theory) for test in tests))
    model = FrfModel(one.model.base.judged_by(data), damping(one.model.base), one.recipes)
    x, hessian = np.insert(one.point.x, own, np.zeros(model.k - own)), np.eye(model.k + model.t)
    elastic = np.r_[0:own, model.k : model.k + model.t]
    hessian[np.ix_(elastic, elastic)] = one.hessian
    return replace(one, model=model, point=replace(one.point, x=x), hessian=hessian)


def _beside(tests: Tests, found: list[tuple[str, str, Fit]], fitted: Tests) -> tuple[FrfFit, ...]:
    """One for each of `tests`, with the models of fits of `fitted`, each with its key and its name."""
    views = [_modelled(one, tests, fitted, key, name) for key, name, one in found]
    fits = []
    for test, *models in zip(tests, *views, strict=True):
        sd, assumed = accuracy(test)
        fits.append(
            FrfFit(test, FORMS[0], np.zeros(0, int), usable(test, sd, "log"), sd, assumed, tuple(models))
        )  # fmt: skip
    return tuple(fits)


def _modelled(one: Fit, tests: Tests, fitted: Tests, key: str, name: str) -> list[Modelled]:
    """The functions of a fit of `fitted` at all lines of `tests`."""
    found = [Modelled(key, name, np.full(t.H.shape, np.nan, complex), np.full(t.H.shape, np.nan)) for t in tests]
    if not tests:
        return found
    x, covariance = _carried(one, fitted, _over(one, tests, slice(0, 1)), tests)
    root, banded = np.linalg.cholesky(covariance), sum(test.H.size for test in tests) * len(x) <= _MOST
    for first in range(0, max(len(test.omega) for test in tests), _LINES):
        at = slice(first, first + _LINES)
        model = _over(one, tests, at)
        with np.errstate(divide="ignore", invalid="ignore"):
            point = model.point(x)
            if point is None:
                continue
            slopes = _parted(model, model.jacobian(point)) if banded else [None] * len(tests)
            for each, part, slope in zip(found, point.parts, slopes, strict=True):
                each.H[at] = part.H
                if banded:
                    each.sd[at] = np.linalg.norm((slope / part.H[..., None]).real @ root, axis=-1)
    return found


def _over(one: Fit, tests: Tests, at: slice) -> FrfModel:
    """The model of a fit at the lines `at` of each of `tests`, nothing whitened."""
    blocks = []
    for test in tests:
        s, shape = test.laplace[at], test.H[at].shape
        blocks.append(Lines(test, s, np.zeros(shape), np.ones(shape), np.ones(shape, bool), of_window(test, s)))
    data = replace(one.model.base.data, blocks=tuple(blocks), modes=None)
    model = FrfModel(one.model.base.judged_by(data), one.model.damping, one.recipes)
    model.losses.middle = one.model.losses.middle  # which loss factors of viscous springs belong to
    return model


def _parted(model: FrfModel, jacobian: np.ndarray) -> list[np.ndarray]:
    """dH/dx (f, o, i, k + t) of each block, of the jacobian of an unwhitened model."""
    found, start = [], 0
    for block in model.base.data.blocks:
        real, imag = np.split(jacobian[start : start + 2 * block.H.size], 2)
        found.append((real + 1j * imag).reshape(*block.H.shape, -1))
        start += 2 * block.H.size
    return found


def _carried(one: Fit, fitted: Tests, model: FrfModel, tests: Tests) -> tuple[np.ndarray, np.ndarray]:
    """x and its covariance for `model` of `tests`: gains and delays that the fit of `fitted` has not are as held likely before."""
    before, after = _chains(one.model, fitted), _chains(model, tests)
    P = np.zeros((model.k + model.t, one.model.k + one.model.t))
    P[: model.lossy, : model.lossy] = np.eye(model.lossy)
    P[model.measured :, one.model.measured :] = np.eye(len(model.theory) + model.t)
    for key in before.keys() & after.keys():
        P[model.lossy + after[key], model.lossy + before[key]] = 1.0
    new = np.diag((~P.any(axis=1)).astype(float))
    return P @ one.point.x, P @ one.covariance @ P.T + new


def _chains(model: FrfModel, tests: Tests) -> dict[tuple[str, ...], int]:
    """Which gain belongs to each response by its name, and to each force by its name and measurement; and which delay."""
    found: dict[tuple[str, ...], int] = {}
    own = model.gains
    for test, outputs, inputs, delays in zip(tests, own.chains.outputs, own.chains.inputs, own.delays, strict=True):
        found |= {(name,): int(k) for name, k in zip(names(test)[0], outputs, strict=True)}
        found |= {("delay", name, ""): int(k) for name, k in zip(names(test)[0], delays, strict=False)}
        found |= {(test.title, name): int(k) for name, k in zip(names(test)[1], inputs, strict=True)}
    return found


def found_damping(one: Fit) -> tuple[Damping, ...]:
    """Loss factor and viscous damping of the structure, each with its standard deviation; those of single modes left out."""
    _, own, *_ = one.model.split(one.point.x)
    values = one.model.damping.values(own)
    spread = np.sqrt(np.diag(one.covariance)[one.model.of_deck : one.model.lossy])
    values, sd = (each[: len(_KINDS)] for each in (values, values * one.model.damping.sd * spread))
    units = one.model.base.problem.units
    return tuple(
        Damping(name, meaning, units.of(unit), float(value), float(own_sd), bool(own_sd < _TOLD * value))
        for (name, meaning, unit), value, own_sd in zip(_KINDS, values, sd, strict=True)
    )
