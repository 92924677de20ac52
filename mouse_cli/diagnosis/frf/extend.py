"""Losses and dashpots as elements of the deck, or in its matrices."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from mouse_cli.diagnosis.extend.edit import Edit
from mouse_cli.diagnosis.extend.matrices import of_matrices
from mouse_cli.diagnosis.extend.places import node_at
from mouse_cli.diagnosis.extend.points import found
from mouse_cli.diagnosis.places.points import Points
from mouse_cli.model.arrays import Matrix, is_sparse
from mouse_cli.model.geometry import DIRECTIONS
from mouse_cli.model.problem import Problem
from mouse_cli.terms.elements import DAMPING

Elements = list[tuple[int, int]]
_SPRINGS = ("spring", "joint")


def with_loss(deck: Problem, before: Problem, name: str, value: float) -> Problem:
    """`deck` with a loss in the springs that `before` has not. name: `loss_factor` or `stiffness_damping`, the property that it is.

    A stretch of bar that is softer has none of its own: the deck is then as it was.
    """
    if of_matrices(before):
        return _with_matrix(deck, name, value * _less(deck.structure.K, before.structure.K))
    edit, known = Edit(deck), max(int(members.ids.max()) for members in before.mesh.elements)
    new = [
        (s, i)
        for s, members in enumerate(edit.sets)
        if members.type in _SPRINGS
        for i in np.flatnonzero(members.ids > known).tolist()
    ]
    if not new:
        return deck
    for s in sorted({s for s, _ in new}):
        members = edit.sets[s]
        values = np.where(members.ids > known, value, 0.0)
        edit.sets[s] = replace(members, properties={**members.properties, name: values})
    return edit.done()


def with_loss_of_the_rest(
    deck: Problem, before: Problem, name: str, value: float, left: float, ids: tuple[int, ...]
) -> Problem:
    """A loss in what is left of a part that lost stiffness since `before`: `left` times what went; ids: of its elements."""
    if of_matrices(before):
        return _with_matrix(deck, name, -left * value * _less(deck.structure.K, before.structure.K))
    edit = Edit(deck)
    edit.put([edit.element(number) for number in ids], name, np.full(len(ids), value))
    return edit.done()


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
    return _with_matrix(problem, name, value * _less(stronger.structure.K, problem.structure.K))


def _with_matrix(deck: Problem, name: str, more: Matrix) -> Problem:
    """`more` in D or C of the deck, by the property that it stands for."""
    matrix = "D" if name == "loss_factor" else "C"
    old = getattr(deck.structure, matrix)
    return replace(deck, structure=replace(deck.structure, **{matrix: more if old is None else old + more}))


def with_dashpot(problem: Problem, point: Points, at: np.ndarray, c: float) -> Problem:
    """A dashpot c (N s/m) from the place to the ground."""
    site = point.site(at)
    if of_matrices(problem):
        C, dof = problem.structure.C, point.dofs[0]
        own = _unit(problem.structure.K, dof) * c
        return replace(problem, structure=replace(problem.structure, C=own if C is None else C + own))
    edit, direction = Edit(problem), DIRECTIONS[point.dofs[0]]
    dashpot = edit.add("dashpot", [[node_at(edit, site)]], {direction: c})
    name = f"dashpot at {site.text}"
    edit.bind(name, dashpot, (direction,), unit=found(name, c, "N s/m").unit)
    return edit.done()


def _less(new: Matrix, old: Matrix) -> Matrix:
    """new - old, where `new` may have further degrees of freedom behind those of `old`."""
    if is_sparse(new):
        from scipy.sparse import coo_array

        stored = coo_array(old)
        return (new - coo_array((stored.data, (stored.row, stored.col)), shape=new.shape)).tocsr()
    wide = np.zeros_like(new)
    wide[: len(old), : len(old)] = old
    return new - wide


def _unit(like: Matrix, dof: int) -> Matrix:
    """1 at one place of the diagonal, dense or sparse as `like`."""
    if is_sparse(like):
        from scipy.sparse import coo_array

        return coo_array((np.ones(1), ([dof], [dof])), shape=like.shape).tocsr()
    one = np.zeros(like.shape)
    one[dof, dof] = 1.0
    return one
