"""Losses as properties of elements of the deck, or in its matrices."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from mouse_cli.diagnosis.extend.edit import Edit
from mouse_cli.diagnosis.extend.matrices import bordered, of_matrices
from mouse_cli.model.arrays import Matrix
from mouse_cli.model.problem import Problem
from mouse_cli.terms.elements import DAMPING

Elements = list[tuple[int, int]]
_MATRIX = {"loss_factor": "D", "stiffness_damping": "C"}  # in which a property of elements ends
_SPRINGS = ("spring", "joint")


def with_loss(deck: Problem, before: Problem, name: str, value: float) -> Problem:
    """`deck` with a loss in the springs that `before` has not. name: `loss_factor` or `stiffness_damping`, the property that it is.

    Elements that are softer by the share 1 - q are their own springs and further ones in series: the loss of these is that of
    the whole times 1 - q, as far as losses are small (energies in series, each with its loss).
    """
    if of_matrices(before):
        return _with_matrix(deck, _MATRIX[name], value * _less(deck.structure.K, before.structure.K))
    edit, known = Edit(deck), max(int(members.ids.max()) for members in before.mesh.elements)
    new = [
        (s, int(i))
        for s, members in enumerate(edit.sets)
        for i in np.flatnonzero(members.ids > known)
        if members.type in _SPRINGS
    ]
    if new:
        edit.put(new, name, np.full(len(new), value))
        return edit.done()
    softer = [b for b in deck.bindings if b.parameter >= len(before.parameters) and b.factor]
    lost = 1 - min((float(deck.prior.mean[b.parameter]) for b in softer), default=1.0)
    elements = sorted({(b.set, int(i)) for b in softer for i in b.members})
    return with_lossy_elements(deck, name, lost * value, lambda _: elements) if lost > 0 else deck


def with_loss_of_the_rest(
    deck: Problem, before: Problem, name: str, value: float, left: float, ids: tuple[int, ...]
) -> Problem:
    """A loss in what is left of a part that lost stiffness since `before`: `left` times what went; ids: of its elements."""
    if of_matrices(before):
        return _with_matrix(deck, _MATRIX[name], -left * value * _less(deck.structure.K, before.structure.K))
    return with_lossy_elements(deck, name, value, lambda edit: [edit.element(number) for number in ids])


def with_lossy_elements(problem: Problem, name: str, value: float, chosen: Callable[[Edit], Elements]) -> Problem:
    """`value` more of the property `name`, one of DAMPING, in the elements that `chosen` finds; its amount is a new parameter."""
    edit = Edit(problem)
    elements = chosen(edit)
    edit.put(elements, name, np.array([edit.values(each, name) + value for each in elements]))
    unit = problem.units.of(DAMPING[name].unit)
    edit.bind(
        f"{name.replace('_', ' ')} of the part that loses energy", elements, (name,), unit="" if unit == "1" else unit
    )
    return edit.done()


def with_lossy_entries(problem: Problem, name: str, value: float, stronger: Problem) -> Problem:
    """`value` times what `stronger` has more of K, in D (`loss_factor`) or C (`stiffness_damping`) of a deck of matrices."""
    return _with_matrix(problem, _MATRIX[name], value * _less(stronger.structure.K, problem.structure.K))


def _with_matrix(deck: Problem, matrix: str, more: Matrix) -> Problem:
    """`more` in `matrix`, C or D, of the deck."""
    old = getattr(deck.structure, matrix)
    return replace(deck, structure=replace(deck.structure, **{matrix: more if old is None else old + more}))


def _less(new: Matrix, old: Matrix) -> Matrix:
    """new - old, where `new` may have further degrees of freedom behind those of `old`."""
    while old.shape != new.shape:
        old = bordered(old)
    return new - old
