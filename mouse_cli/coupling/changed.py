"""A model with connections added to its constant matrices; the parameters and what they move stay as they are."""

from dataclasses import replace

import numpy as np

from mouse_cli.coupling.connections import tuned
from mouse_cli.coupling.whole import added
from mouse_cli.dynamics.frequency import frequency_hz
from mouse_cli.model.arrays import Matrix, is_sparse
from mouse_cli.model.coupling import Connection
from mouse_cli.model.geometry import Geometry
from mouse_cli.model.problem import Problem
from mouse_cli.model.structure import Structure


def changed(problem: Problem, connections: tuple[Connection, ...], b: Matrix) -> Problem:
    """K + dK, M + dM, ... of `problem`, for modal damping that is already a term; b (k, n): rows of motion of the connections.

    Each absorber adds a degree of freedom at the end, named `absorber 1`, .... There is no test any more: it was that of the model
    before.
    """
    structure = problem.structure
    changes = dict(zip(("K", "M", "C", "D"), added(connections, b, structure.n), strict=True))
    hung = [one for one in connections if one.hung]
    found = {
        name: _sum(getattr(structure, name), change, is_sparse(structure.K))
        for name, change in changes.items()
        if change.nnz or getattr(structure, name) is not None
    }
    labels = (*structure.labels, *(f"absorber {i}" for i in range(1, len(hung) + 1)))
    new = Structure(labels=labels, geometry=_geometry(structure.geometry, len(hung)), **found)
    return replace(
        problem, structure=new, test=None, frf=(), recordings=(), hold_out=None, held_records=None, laws=(), modal_damping=None
    )  # fmt: skip


def motion(connections: tuple[Connection, ...], weights: Matrix) -> Matrix:
    """Rows b (k, n) of what each connection sees, from those of the places (r, n)."""
    from scipy.sparse import csr_array, vstack

    rows = [
        weights[[one.at.place]] - weights[[one.to.place]] if one.to else weights[[one.at.place]] for one in connections
    ]
    return csr_array(vstack(rows)) if rows else csr_array((0, weights.shape[1]))


def resolved(
    connections: tuple[Connection, ...], eigenvalues: np.ndarray, shapes: np.ndarray, b: Matrix
) -> tuple[Connection, ...]:
    """Connections with absorbers tuned to modes of the model; shapes (n, k)."""
    found = []
    for k, one in enumerate(connections):
        if one.tuned_to is not None:
            mode = one.tuned_to - 1
            moved = float((b[[k]] @ shapes[:, mode])[0]) ** 2
            one = tuned(one, float(frequency_hz(eigenvalues[mode])), 1 / moved if moved > 0 else np.inf)
        found.append(one)
    return tuple(found)


def _sum(constant: Matrix | None, change: Matrix, sparse: bool) -> Matrix:
    """`constant`, padded, plus `change`; dense where the model is."""
    if not sparse:
        found = change.toarray()
        if constant is not None:
            found[: len(constant), : len(constant)] += constant
        return found
    if constant is None:
        return change
    wide = constant.tocsr().copy()
    wide.resize(change.shape)
    return (wide + change).tocsr()


def _geometry(geometry: Geometry | None, more: int) -> Geometry | None:
    """With `more` degrees of freedom that belong to no node."""
    if geometry is None or not more:
        return geometry
    ends = np.full(more, -1), np.zeros(more, int)
    return replace(
        geometry, node=np.concatenate([geometry.node, ends[0]]), direction=np.concatenate([geometry.direction, ends[1]])
    )
