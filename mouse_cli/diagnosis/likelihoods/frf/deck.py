"""The damping that functions show, put into the deck with the cause, so that `mouse run` fits the functions from there."""

from dataclasses import replace

import numpy as np

from mouse_cli.diagnosis.extend.edit import Edit
from mouse_cli.diagnosis.extend.matrices import of_matrices
from mouse_cli.diagnosis.likelihoods.frf.compared import found_damping, of_functions
from mouse_cli.diagnosis.likelihoods.frf.lossy import SAME
from mouse_cli.diagnosis.likelihoods.frf.model import FrfModel
from mouse_cli.diagnosis.search.fit import Fit
from mouse_cli.model.arrays import Matrix, is_sparse
from mouse_cli.model.problem import Problem
from mouse_cli.terms.assembly import assembly
from mouse_cli.terms.elements import DAMPING, registry

_OF_CAUSES = ("spring", "joint", "mass")  # types of elements that a cause brings with it
_CYCLES = 150  # at most, as sharp resonances and losses make valleys that are followed in short steps
_NAMES = ("loss_factor", "mass_damping", "stiffness_damping")  # in the order of `found_damping`
Members = list[tuple[int, int]]


def with_damping(deck: Problem, before: Problem, one: Fit) -> Problem:
    """`deck`, which is `before` with the causes of the fit `one`, with the damping of structure and causes as it was found.

    Amounts that the functions tell become parameters. A deck whose own parameters move damping keeps it, and estimates it itself.
    """
    fit = of_functions(one)
    own = before.modal_damping or any(b.property in DAMPING for b in before.bindings)
    if own or not isinstance(fit.model, FrfModel):
        return deck
    deck = replace(deck, run=replace(deck.run, partials=max(deck.run.partials, _CYCLES)))
    *found, ratio = found_damping(fit)
    alike = 2 * ratio.value if ratio.determined else 0.0  # as a loss factor, which damps each mode at its resonance as much
    found = [replace(found[0], value=found[0].value + alike, determined=found[0].determined or alike > 0), *found[1:]]
    stated = fit.model.damping.stated
    if of_matrices(deck):
        same = all(recipe.law == SAME for recipe in one.recipes)
        eta, alpha, beta = (each.value for each in found)  # all of them, as no parameter stands for what is left out
        return _in_matrices(deck, deck if same else before, eta - stated, alpha, beta)
    edit, known = Edit(deck), max(int(members.ids.max()) for members in before.mesh.elements)
    brought = [at for at in _all(edit) if edit.sets[at[0]].type in _OF_CAUSES and _id(edit, at) > known]
    own_law = [at for at in brought if any(edit.values(at, name) for name in _NAMES if _has(edit, at, name))]
    structure = [at for at in _all(edit) if at not in own_law]
    for name, each in zip(_NAMES, found, strict=True):
        damped = [at for at in structure if _has(edit, at, name) and (name != "mass_damping" or at not in brought)]
        if name != "loss_factor" and not each.determined:
            continue
        less = stated if name == "loss_factor" else 0.0
        values = [each.value + (0.0 if at in brought else edit.values(at, name) - less) for at in damped]
        edit.put(damped, name, np.array(values))
        taken = {(b.set, int(i)) for b in edit.bindings if b.property == name for i in b.members}  # by a cause
        free = [at for at in damped if at not in taken]
        if each.determined and free:
            edit.bind(f"{each.name} of the structure", free, (name,), unit="" if each.unit == "1" else each.unit)
    for name in _NAMES:
        lossy = [at for at in own_law if _has(edit, at, name) and edit.values(at, name)]
        if lossy:
            unit = fit.model.base.problem.units.of(DAMPING[name].unit)
            edit.bind(f"{name.replace('_', ' ')} of the cause", lossy, (name,), unit="" if unit == "1" else unit)
    return edit.done()


def _all(edit: Edit) -> Members:
    return [(s, i) for s, members in enumerate(edit.sets) for i in range(len(members))]


def _id(edit: Edit, at: tuple[int, int]) -> int:
    return int(edit.sets[at[0]].ids[at[1]])


def _has(edit: Edit, at: tuple[int, int], name: str) -> bool:
    return name in registry()[edit.sets[at[0]].type].damping


def _in_matrices(deck: Problem, damped: Problem, eta: float, alpha: float, beta: float) -> Problem:
    """`deck` with the damping of all that is in `damped`; in a model of matrices D and C are constant, and no parameter."""
    old = deck.structure
    K, M = (_widened(matrix, old.n) for matrix in assembly(damped).matrices(damped.prior.mean))
    found = {"D": eta * K, "C": alpha * M + beta * K}
    for name, matrix in found.items():
        own = getattr(old, name)
        found[name] = matrix if own is None else own + matrix
    return replace(deck, structure=replace(old, **found))


def _widened(matrix: Matrix, n: int) -> Matrix:
    """The matrix with zeros for degrees of freedom that a cause has added behind its own."""
    more = n - matrix.shape[0]
    if not is_sparse(matrix):
        return np.pad(matrix, (0, more))
    from scipy.sparse import coo_array

    stored = coo_array(matrix)
    return coo_array((stored.data, (stored.row, stored.col)), shape=(n, n)).tocsr()
