"""The deck with the named causes in it, and what it holds out brought to its degrees of freedom."""

from dataclasses import replace

import numpy as np

from mouse_cli.diagnosis.effects.sensors import name, readings
from mouse_cli.diagnosis.extend.renumbered import moved, moved_channels, moved_functions
from mouse_cli.diagnosis.nameless.fit import extended as of_field
from mouse_cli.diagnosis.search.fit import Fit
from mouse_cli.model.hold_out import HoldOut
from mouse_cli.model.modal_test import ModalTest
from mouse_cli.model.problem import Problem


def extended(problem: Problem, one: Fit, which: tuple[int, ...] | None = None) -> Problem | None:
    """The deck with each mechanism of a fit (of those numbered `which`) added as a parameter, or its field; None where one cannot
    be put into a deck.
    """
    deck = of_field(problem, one) if one.nameless else problem
    if deck is None:
        return None
    pairs = list(zip(one.recipes, one.model.own, strict=True))
    for recipe, own in pairs if which is None else [pairs[i] for i in which]:
        if recipe.extend is None:
            return None
        deck = recipe.extend(deck, recipe.values(one.c[own]))
    return with_what_is_held_out(in_its_units(deck, len(problem.parameters)), problem)


def with_what_is_held_out(deck: Problem, problem: Problem) -> Problem:
    """`deck`, which was made of `problem`, with what that holds out brought to its degrees of freedom."""
    place = {label: i for i, label in enumerate(deck.structure.labels)}
    to = np.array([place[label] for label in problem.structure.labels], int)
    if problem.held_records is not None:
        held = problem.held_records
        functions = tuple(moved_functions(each, to, deck.structure.n) for each in held.frf)
        recordings = tuple(moved_channels(each, to) for each in held.recordings)
        deck = replace(deck, held_records=replace(held, frf=functions, recordings=recordings))
    if problem.hold_out is None:
        return deck
    held = _moved(problem.hold_out, to, deck.structure.n)
    if deck.test.sensors != problem.test.sensors or (deck.test.dofs != to[problem.test.dofs]).any():
        held = replace(held, whole=_corrected(held, replace(deck, test=held.whole), deck.test))
    return replace(deck, hold_out=held)


def _corrected(held: HoldOut, whole: Problem, fitted: ModalTest) -> ModalTest:
    """The whole test, the sensors that fits use read as those of `fitted`, which a cause has corrected."""
    from scipy.sparse import csr_array, vstack

    test, n = held.whole, whole.structure.n
    kept = np.setdiff1d(np.arange(test.s), held.sensors).tolist()
    dofs = np.array([fitted.dofs[kept.index(k)] if k in kept else test.dofs[k] for k in range(test.s)])
    if fitted.sensing is None:
        return replace(test, dofs=dofs)
    old, new = readings(test, n), readings(fitted, n)
    rows = vstack([new[[kept.index(k)]] if k in kept else old[[k]] for k in range(test.s)])
    names = tuple(fitted.sensors[kept.index(k)] if k in kept else name(whole, k) for k in range(test.s))
    return replace(test, dofs=dofs, sensing=csr_array(rows), sensors=names)


def in_its_units(deck: Problem, own: int) -> Problem:
    """The units of parameters after the first `own`, which candidates give in SI, as the deck declares them."""
    new = tuple(replace(each, unit=deck.units.of(each.unit)) for each in deck.parameters[own:])
    return replace(deck, parameters=deck.parameters[:own] + new)


def _moved(held: HoldOut, to: np.ndarray, n: int) -> HoldOut:
    """What is held out when degree of freedom i (from 0) of a model has become to[i] of n."""
    altered = tuple(
        replace(
            one,
            masses={int(to[dof]): value for dof, value in one.masses.items()},
            springs={int(to[dof]): value for dof, value in one.springs.items()},
        )
        for one in held.altered
    )
    return replace(held, whole=moved(held.whole, to, n), altered=altered)
