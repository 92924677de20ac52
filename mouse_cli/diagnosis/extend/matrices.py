"""A model of matrices with something added: listed elements that a new parameter moves, and further degrees of freedom."""

from dataclasses import replace

import numpy as np

from mouse_cli.diagnosis.extend.renumbered import moved, moved_functions
from mouse_cli.model.arrays import Matrix, is_sparse
from mouse_cli.model.parameter import Gaussian, Parameter
from mouse_cli.model.problem import Problem
from mouse_cli.model.structure import ListedElements
from mouse_cli.terms.further import with_parameters

Entries = tuple[np.ndarray, np.ndarray, np.ndarray]  # rows <= columns, from 0, and values for one unit of the parameter
NOTHING: Entries = (np.zeros(0, int), np.zeros(0, int), np.zeros(0))


def of_matrices(problem: Problem) -> bool:
    """Whether the deck's degrees of freedom are not those of nodes of a mesh of its own."""
    return problem.mesh is None or problem.structure.geometry is None


def with_entries(problem: Problem, parameter: Parameter, K: Entries = NOTHING, M: Entries = NOTHING) -> Problem:
    """The deck with `parameter` times `K` and `M` in its matrices, and `parameter` among those that are estimated."""
    row, col, value = (np.concatenate([k, m]) for k, m in zip(K, M, strict=True))
    is_mass = np.repeat([False, True], [len(K[0]), len(M[0])])
    listed = problem.elements
    known = {
        key: i
        for i, key in enumerate(zip(listed.is_mass.tolist(), listed.row.tolist(), listed.col.tolist(), strict=True))
    }
    keys = list(zip(is_mass.tolist(), row.tolist(), col.tolist(), strict=True))
    for key in keys:
        known.setdefault(key, len(known))
    order = sorted(known, key=lambda key: (key[0], known[key]))
    deck = with_parameters(problem, [parameter])
    place = {key: i for i, key in enumerate(order)}
    old = np.array([place[key] for key in list(known)[: len(listed)]], int)
    A = _spread(deck.A, old, len(order), np.array([place[key] for key in keys], int), value)
    structure = problem.structure
    nominal = parameter.nominal
    changed = {name: plus(getattr(structure, name), part, nominal) for name, part in (("K", K), ("M", M))}
    elements = ListedElements(*(np.array([key[k] for key in order]) for k in range(3)))
    return replace(deck, structure=replace(structure, **changed), elements=elements, A=A)


def with_part_left(
    problem: Problem, left: Parameter, K: tuple[Entries, np.ndarray], M: tuple[Entries, np.ndarray]
) -> Problem:
    """The deck with a part of it, its entries in K and M, times `left`, so that none of it is there at 0.

    With the entries: how the share of the part grows with each parameter (p,), which then moves what is left of it alone.
    """
    gone = {name: plus(getattr(problem.structure, name), part[0], -1.0) for name, part in (("K", K), ("M", M))}
    deck = _following(problem, 1 - left.nominal, K, M)
    return with_entries(replace(deck, structure=replace(problem.structure, **gone)), left, K[0], M[0])


def with_powers(
    problem: Problem, name: str, unit: str, nominal: float, size: float,
    by: list[tuple[float, str, tuple[Entries, np.ndarray], tuple[Entries, np.ndarray]]],
) -> Problem:  # fmt: skip
    """The deck with a part of it that goes by powers of a parameter, `name`, which is `nominal` in it, now `size` times that.

    by: for each power n what its parameter is called after `name`, and what goes by it in K and M, as in `with_part_left`. The
    prior holds ln theta_n = n ln theta, sd n: theta_n is theta^n in every fit.
    """
    deck, first = problem, len(problem.parameters)
    for n, after, K, M in by:
        deck = _following(deck, 1 - size**n, K, M)
        changed = {x: plus(getattr(deck.structure, x), part[0], -1.0) for x, part in (("K", K), ("M", M))}
        value = (nominal * size) ** n
        power = Parameter(name + after, abs(n) * value, value, f"({unit})^{n:g}" if n != 1 else unit, transform="log")
        own = ((*part[0][:2], part[0][2] / nominal**n) for part in (K, M))
        deck = with_entries(replace(deck, structure=replace(deck.structure, **changed)), power, *own)
    covariance, spread = deck.prior.dense(), np.array([n * (nominal * size) ** n for n, *_ in by])
    covariance[first:, first:] = np.outer(spread, spread)
    return replace(deck, prior=Gaussian(deck.prior.mean, covariance))


def _following(problem: Problem, share: float, K: tuple[Entries, np.ndarray], M: tuple[Entries, np.ndarray]) -> Problem:
    """The deck whose parameters move what is left of a part, as `with_part_left` takes it, after `share` of it is gone."""
    listed, A = problem.elements, problem.A
    keys = zip(listed.is_mass.tolist(), listed.row.tolist(), listed.col.tolist(), strict=True)
    place = {key: i for i, key in enumerate(keys)}
    for mass, ((rows, cols, values), slopes) in enumerate((K, M)):
        at = np.array(
            [place.get((bool(mass), i, j), -1) for i, j in zip(rows.tolist(), cols.tolist(), strict=True)], int
        )
        A = _less(A, at[at >= 0], share * values[at >= 0], slopes)
    return replace(problem, A=A)


def _less(A: Matrix, at: np.ndarray, values: np.ndarray, slopes: np.ndarray) -> Matrix:
    """A (e, p) without `values` times `slopes` (p,) in the rows `at`."""
    wide = np.zeros(A.shape[1])
    wide[: len(slopes)] = slopes
    own = np.flatnonzero(wide)
    if not is_sparse(A):
        found = np.array(A)
        found[np.ix_(at, own)] -= np.outer(values, wide[own])
        return found
    from scipy.sparse import coo_array

    each = np.repeat(at, len(own)), np.tile(own, len(at))
    return (A - coo_array((np.outer(values, wide[own]).ravel(), each), shape=A.shape)).tocsr()


def with_shares(problem: Problem, what: str, shares: list[tuple[str, float, Entries]], sd: float) -> Problem:
    """The deck with each of `shares` (where, value, entries) of its matrix `what` as a parameter N(value, sd)."""
    for where, value, entries in shares:
        share = Parameter(f"share of {what}, {where}", sd, value, "1")
        problem = with_entries(problem, share, **{"M" if what == "mass" else "K": entries})
    return problem


def with_tie(problem: Problem, dofs: np.ndarray, b: np.ndarray, sign: int) -> Problem:
    """The deck with K + sign a b b' over the degrees of freedom `dofs` (c,), and a = 1, its amount, a parameter."""
    row, col = np.triu_indices(len(dofs))
    low, high = np.minimum(dofs[row], dofs[col]), np.maximum(dofs[row], dofs[col])
    amount = Parameter("amount of the spring along its motion", 1.0, 1.0, "1", transform="log")
    return with_entries(problem, amount, K=(low, high, sign * b[row] * b[col]))


def _spread(A: Matrix, old: np.ndarray, e: int, at: np.ndarray, value: np.ndarray) -> Matrix:
    """A (e, p) with its former rows at `old`, and `value` at the rows `at` of its last column."""
    if not is_sparse(A):
        found = np.zeros((e, A.shape[1]))
        found[old] = A
        np.add.at(found[:, -1], at, value)
        return found
    from scipy.sparse import coo_array

    stored = A.tocoo()
    rows = np.concatenate([old[stored.row], at])
    cols = np.concatenate([stored.col, np.full(len(at), A.shape[1] - 1)])
    return coo_array((np.concatenate([stored.data, value]), (rows, cols)), shape=(e, A.shape[1])).tocsr()


def plus(matrix: Matrix, entries: Entries, factor: float) -> Matrix:
    """A symmetric matrix, dense or sparse, and `factor` times `entries` of its upper triangle in both."""
    row, col, value = entries
    off = row != col
    at = np.concatenate([row, col[off]]), np.concatenate([col, row[off]])
    values = factor * np.concatenate([value, value[off]])
    if is_sparse(matrix):
        from scipy.sparse import coo_array

        return (matrix + coo_array((values, at), shape=matrix.shape)).tocsr()
    found = np.array(matrix)
    np.add.at(found, at, values)
    return found


def with_degree_of_freedom(problem: Problem, label: str) -> Problem:
    """The deck with one more row and column in its matrices, zero as yet."""
    from mouse_cli.diagnosis.extend.edit import Edit

    structure, n = problem.structure, problem.structure.n
    changed = {}
    for name in ("K", "M", "C", "D"):
        matrix = getattr(structure, name)
        if matrix is not None:
            changed[name] = bordered(matrix)
    geometry = structure.geometry
    if geometry is not None:
        node, direction = (np.append(part, -1) for part in (geometry.node, geometry.direction))
        geometry = replace(geometry, node=node, direction=direction)
    larger = replace(structure, **changed, labels=(*structure.labels, label), geometry=geometry)
    test = None if problem.test is None else moved(problem.test, np.arange(n), n + 1)
    functions = tuple(moved_functions(each, np.arange(n), n + 1) for each in problem.frf)
    deck = replace(problem, structure=larger, test=test, frf=functions)
    if problem.mesh is None:
        return deck
    edit = Edit(deck)
    edit.node(np.zeros(3))
    return edit.done()


def bordered(matrix: Matrix) -> Matrix:
    """A matrix with one more row and column of zeros."""
    if not is_sparse(matrix):
        return np.pad(matrix, (0, 1))
    from scipy.sparse import block_diag, csr_array

    return csr_array(block_diag([matrix, csr_array((1, 1))]))
