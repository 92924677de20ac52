"""The deck with named supports of imported matrices on springs: they move as the columns of a pattern say."""

from dataclasses import replace

import numpy as np

from mouse_cli.diagnosis.extend.matrices import with_entries
from mouse_cli.diagnosis.extend.points import found
from mouse_cli.diagnosis.extend.renumbered import moved, moved_functions
from mouse_cli.model.arrays import Matrix, is_sparse, upper_triangle
from mouse_cli.model.held import ElementGroup, Held, Support, applied, freed, places
from mouse_cli.model.problem import Problem
from mouse_cli.model.structure import ListedElements, Structure

_Stiffnesses = dict[str, tuple[np.ndarray, float]]  # bed and k of each, by its name


def with_motions(
    problem: Problem, names: tuple[str, ...], pattern: np.ndarray, labels: tuple[str, ...], stiffnesses: _Stiffnesses, unit: str
) -> Problem:
    """u_s = P q for the supports called `names`, pattern P (k, a) and motions q, with springs k times bed (a, a) against them, of
    which `stiffnesses` has each bed and k, by the names of their parameters.

    A motion of one degree of freedom alone is that degree of freedom, under its own name.
    """
    whole, to = freed(problem), places(problem)
    n, a = whole.structure.n, pattern.shape[1]
    s = np.concatenate([each.dofs for name in names for each in problem.held.supports if each.name == name])
    rest = np.setdiff1d(np.arange(n), s)
    T, number = _followed(n, rest, s, pattern), np.full(n, -1)
    number[rest] = np.arange(len(rest))
    structure = _structure(whole, T, rest, _called(whole, s, pattern, labels))
    supports = tuple(replace(each, dofs=number[each.dofs]) for each in problem.held.supports if each.name not in names)
    others = np.concatenate([each.dofs for each in supports]) if supports else np.zeros(0, int)
    kept = np.setdiff1d(np.arange(structure.n), others)
    elements, A = _listed(whole, T, structure.n)
    place = np.full(structure.n, -1)
    place[kept] = np.arange(len(kept))
    inside = (place[elements.row] >= 0) & (place[elements.col] >= 0)
    reduced = applied(structure, kept)
    own = place[number[to]]
    deck = replace(
        problem,
        structure=reduced,
        elements=_some(elements, inside, place),
        A=A[np.flatnonzero(inside)],
        held=_held(structure, supports, kept, _some(elements, ~inside), A[np.flatnonzero(~inside)]),
        groups=tuple(_group(each, T, n) for each in problem.groups),
        test=None if problem.test is None else moved(problem.test, own, reduced.n),
        frf=tuple(moved_functions(each, own, reduced.n) for each in problem.frf),
    )
    row, col = np.triu_indices(a)
    at = place[len(rest) + np.arange(a)]
    for name, (bed, k) in stiffnesses.items():
        deck = with_entries(deck, found(name, k, unit), K=(at[row], at[col], bed[row, col]))
    return deck


def _held(structure: Structure, supports: tuple[Support, ...], *rest) -> Held | None:
    """What is still held; None where nothing is."""
    return Held(structure, supports, *rest) if supports else None


def _followed(n: int, rest: np.ndarray, s: np.ndarray, pattern: np.ndarray) -> Matrix:
    """T (n, n - k + a): the rest as it is, the support as its motions move it."""
    from scipy.sparse import coo_array

    i, j = np.nonzero(pattern)
    row = np.concatenate([rest, s[i]])
    col = np.concatenate([np.arange(len(rest)), len(rest) + j])
    values = np.concatenate([np.ones(len(rest)), pattern[i, j]])
    return coo_array((values, (row, col)), shape=(n, len(rest) + pattern.shape[1])).tocsr()


_Called = tuple[tuple[str, ...], np.ndarray, np.ndarray]  # label, node (-1: none) and direction of each motion


def _called(whole: Problem, s: np.ndarray, pattern: np.ndarray, labels: tuple[str, ...]) -> _Called:
    at, (dof, motion) = whole.structure.geometry, np.nonzero(pattern)
    alone = np.flatnonzero((np.count_nonzero(pattern, axis=0) == 1) & (pattern.max(axis=0) == 1.0))
    own = {int(j): int(s[dof[motion == j][0]]) for j in alone}
    node, direction, names = np.full(len(labels), -1), np.ones(len(labels), int), list(labels)
    for j, i in own.items():
        names[j] = whole.structure.labels[i]
        if at is not None:
            node[j], direction[j] = at.node[i], at.direction[i]
    return tuple(names), node, direction


def _structure(whole: Problem, T: Matrix, rest: np.ndarray, called: _Called):
    old, (labels, node, direction) = whole.structure, called
    parts = {name: getattr(old, name) for name in ("K", "M", "C", "D")}
    at = old.geometry
    geometry = None
    if at is not None:
        geometry = replace(at, node=np.append(at.node[rest], node), direction=np.append(at.direction[rest], direction))
    named = tuple(old.labels[i] for i in rest) + labels
    return replace(
        old, **{k: None if m is None else _brought(m, T) for k, m in parts.items()}, labels=named, geometry=geometry
    )


def _brought(matrix: Matrix, T: Matrix) -> Matrix:
    return (T.T @ (matrix @ T)).tocsr() if is_sparse(matrix) else T.T @ (T.T @ matrix).T


def _listed(whole: Problem, T: Matrix, n: int) -> tuple[ListedElements, Matrix]:
    """T' dK T and T' dM T of each parameter, as listed elements (e,) and A (e, p)."""
    from scipy.sparse import coo_array

    listed, A = whole.elements, whole.A
    keys, values, owner = [], [], []
    for j in range(A.shape[1]):
        column = np.ravel(A[:, [j]].toarray() if is_sparse(A) else A[:, j])
        for mass in (False, True):
            own = np.flatnonzero((column != 0) & (listed.is_mass == mass))
            if not len(own):
                continue
            low, high, value = listed.row[own], listed.col[own], column[own]
            off = low != high
            at = np.concatenate([low, high[off]]), np.concatenate([high, low[off]])
            matrix = coo_array((np.append(value, value[off]), at), shape=(T.shape[0],) * 2).tocsr()
            row, col, entries = upper_triangle((T.T @ matrix @ T).tocsr())
            keys.append((mass * n + row.astype(np.int64)) * n + col)
            values.append(entries)
            owner.append(np.full(len(row), j))
    if not keys:
        return ListedElements.none(), np.zeros((0, A.shape[1]))
    places, index = np.unique(np.concatenate(keys), return_inverse=True)
    found = coo_array((np.concatenate(values), (index, np.concatenate(owner))), shape=(len(places), A.shape[1])).tocsr()
    row, col = places // n, places % n
    return ListedElements(row >= n, row % n, col), found if is_sparse(A) else found.toarray()


def _some(elements: ListedElements, which: np.ndarray, place: np.ndarray | None = None) -> ListedElements:
    row, col = elements.row[which], elements.col[which]
    if place is not None:
        row, col = place[row], place[col]
    return ListedElements(elements.is_mass[which], row, col)


def _group(group: ElementGroup, T: Matrix, n: int) -> ElementGroup:
    own = lambda m: m if m is None or m.shape[0] != n else _brought(m, T)
    by_power = lambda parts: {power: own(each) for power, each in parts.items()}
    thick = group.thickness
    thick = thick if thick is None else replace(thick, K=by_power(thick.K), M=by_power(thick.M))
    missing = None if group.missing is None else tuple(map(own, group.missing))
    return replace(group, K=own(group.K), M=own(group.M), thickness=thick, missing=missing)
