"""The matrices of each group, from as few exports as there are colours: K' - K = (s - 1) K_g where a job scales group g by s."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np

from mouse_cli.importing.calculix import Exported, Solver, cores
from mouse_cli.importing.jobs import SCALE, colours, export
from mouse_cli.importing.model import InputModel
from mouse_cli.model.arrays import Matrix

_DIGITS = 1e-12  # of an element of a matrix: what the solver's files do not hold of a difference


@dataclass(frozen=True)
class Parts:
    """The whole, and K and M (n, n) of each group of the model, in its order; jobs: how many were run for it.

    error: largest element of the sum of the parts less the whole, over the largest of the whole, of K and of M.
    """

    whole: Exported
    K: list[Matrix]
    M: list[Matrix]
    jobs: int
    error: tuple[float, float]


def parts(
    model: InputModel, solver: Solver, meanwhile: Callable[[Exported], None] = lambda whole: None, thick: float = 1.0
) -> Parts:
    """Exports the model and its groups; meanwhile: done with the whole before the groups are read. Raises DeckError (MD274).

    thick: thickness of all shells over that of the file, of which it then exports the groups of shells alone.
    """
    from scipy.sparse import csr_array

    own, classes = model.known, colours(model)
    if thick != 1.0:
        classes = [each for each in ([i for i in one if model.groups[i].shell] for one in classes) if each]
    jobs = [(export(model, chosen, thick), title) for chosen, title in _titled(model, classes, thick)]
    ahead = cores() + 1
    solver.begin(jobs[:ahead])
    whole = solver.matrices(*jobs[0], *own)
    meanwhile(whole)
    n = whole.K.shape[0]
    K, M = ([csr_array((n, n)) for _ in model.groups] for _ in range(2))
    for i, chosen in enumerate(classes, 1):
        scaled = solver.matrices(*jobs[i], *own)
        solver.begin(jobs[i + ahead - 1 : i + ahead])
        moved = [difference(getattr(scaled, x), getattr(whole, x)) / (SCALE - 1) for x in "KM"]
        owner = _owners(model, chosen, moved, whole.rows.names[:, 0])
        for into, own_part in zip((K, M), moved, strict=True):
            for i in chosen:
                into[i] = _rows_of(own_part, owner == i)
    error = tuple(_error(each, getattr(whole, x)) for each, x in ((K, "K"), (M, "M")))
    return Parts(whole, K, M, len(jobs), error)


def _titled(model: InputModel, classes: list[list[int]], thick: float) -> Iterator[tuple[list[int], str]]:
    """Groups (numbers) that each export scales, and its title: the whole first."""
    total, at = len(classes) + 1, "" if thick == 1.0 else f" at {thick:g} times the thickness"
    yield [], f"export 1 of {total}{at}: the whole"
    for j, chosen in enumerate(classes, 2):
        names = ", ".join(model.groups[i].name for i in chosen[:4]) + (", ..." if len(chosen) > 4 else "")
        yield chosen, f"export {j} of {total}{at}: {names}"


def difference(changed: Matrix, whole: Matrix) -> Matrix:
    """What two exports differ by: elements that differ by rounding of the files alone are none."""
    if np.array_equal(changed.indptr, whole.indptr) and np.array_equal(changed.indices, whole.indices):
        from scipy.sparse import csr_array

        values = changed.data - whole.data
        values[np.abs(values) <= _DIGITS * np.maximum(np.abs(changed.data), np.abs(whole.data))] = 0.0
        found = csr_array((values, whole.indices.copy(), whole.indptr.copy()), shape=whole.shape)
    else:
        found = (changed - whole).tocsr()
        close = abs(found) - abs(changed).maximum(abs(whole)) * _DIGITS
        found = found.multiply((close > 0).astype(float)).tocsr()
    found.eliminate_zeros()
    return found


def _owners(model: InputModel, chosen: list[int], differences: list[Matrix], nodes: np.ndarray) -> np.ndarray:
    """Group (n,) of each row, -1 for none: rows that are coupled are of one group, which shares no node with others."""
    from scipy.sparse.csgraph import connected_components

    if len(chosen) == 1:
        return np.full(len(nodes), chosen[0])
    touched = {node: i for i in chosen for e in model.groups[i].elements for node in model.elements[e][1]}
    pattern = abs(differences[0]) + abs(differences[1])
    count, part = connected_components(pattern, directed=False)
    by_part = np.full(count, -1)
    for row, node in enumerate(nodes.tolist()):
        if node in touched:
            by_part[part[row]] = touched[node]
    return by_part[part]


def _rows_of(matrix: Matrix, mask: np.ndarray) -> Matrix:
    from scipy.sparse import diags_array

    if mask.all():
        return matrix
    found = (diags_array(mask.astype(float)) @ matrix).tocsr()
    found.eliminate_zeros()
    return found


def _error(each: list[Matrix], whole: Matrix) -> float:
    largest = abs(whole).max()
    return float(abs(sum(each[1:], each[0]) - whole).max() / largest) if largest else 0.0
