"""What the rows of CalculiX's matrices are, and coordinates in which every node of the input moves as its supports hold it.

Shells and beams become solids there, and the rows of all solid nodes that a node of the input became bear its number, in the
order bottom (middle) top. Its own motion is their mean: of the outer two of three (S8 and S6, where supports hold the middle one
too), of the first four of eight (B32), of all else. That mean, and what the others move beside it, take the place of the rows.
Where a spring, a mass or an equation acts on such a node, the mean is a row itself, before all rows of solids, and one of those is
not there.
"""

from dataclasses import dataclass

import numpy as np

from mouse_cli.importing.model import Clamp
from mouse_cli.model.arrays import Matrix

_OUTER = {3: (0, 2), 8: (0, 1, 2, 3)}  # of so many rows of one node and direction, those whose mean is its motion
_SCALAR = 0  # direction of what is no motion of a node of the input


@dataclass(frozen=True)
class Rows:
    """T (n, n): from the new coordinates to the rows of the solver, None: the same; names (n, 2): node, direction 1 to 6,
    0 with a number of its own for what is no motion of a node of the input.

    held: for (node, direction) of the input, the coordinates (from 0) that a support of it holds. beside (n,): the node of the
    input whose mean a coordinate is measured from, 0 for none; middle (n,): whether it is of a row between the outer ones.
    follows: coordinates by the (node, direction) whose mean is none of them, as a constraint determines it. dofs (n, 2): the
    rows as the solver names them.
    """

    T: Matrix | None
    names: np.ndarray
    held: dict[tuple[int, int], tuple[int, ...]]
    beside: np.ndarray
    middle: np.ndarray
    follows: dict[tuple[int, int], tuple[int, ...]]
    dofs: np.ndarray

    def brought(self, matrix: Matrix) -> Matrix:
        """T' matrix T."""
        return matrix if self.T is None else (self.T.T @ matrix @ self.T).tocsr()


def rows(
    dofs: np.ndarray, own: dict[int, Clamp | None], pointed: frozenset[int] = frozenset(), layers: dict[int, int] | None = None,
    axes: dict[int, np.ndarray] | None = None,
) -> Rows:  # fmt: skip
    """dofs (n, 2): node and direction as the solver names its rows; own: nodes of the input; pointed: those at which something
    acts but solids; layers: nodes through the thickness that one of shells becomes; axes (3, 3) of nodes
    whose motions are along these.

    Where rotations of shells are held, what their faces move along them, beside the mean, is said by rotations.
    """
    places: dict[tuple[int, int], list[int]] = {}
    for i, (node, direction) in enumerate(dofs.tolist()):
        places.setdefault((node, direction), []).append(i)
    names, held, blocks, beside, middle = dofs.copy(), {}, [], np.zeros(len(dofs), int), np.zeros(len(dofs), bool)
    top, first, follows = max(int(dofs[:, 0].max()), max(own, default=0)), _points(dofs), {}
    for (node, direction), at in places.items():
        if node not in own:
            names[at] = [(top + 1 + i, _SCALAR) for i in at]
        if at[0] >= first and len(at) < (layers or {}).get(node, 0):
            follows[node, direction], middle[at[:-1]] = tuple(at), True
            names[at[1:]] = np.reshape([(top + 1 + i, _SCALAR) for i in at[1:]], (-1, 2))
            held[node, direction] = (at[0],)
            continue
        if len(at) == 1:
            held[node, direction] = (at[0],)
            continue
        outer = [at[k] for k in _OUTER.get(len(at), range(len(at)))]
        outer = at[:1] if node in pointed and at[0] < first else outer
        rest = [i for i in at if i not in outer]
        held[node, direction] = (outer[0], *rest) if len(at) == 3 and len(outer) > 1 else (outer[0],)
        blocks.append((outer, rest))
        middle[rest if len(outer) > 1 else rest[:-1]] = node in (layers or {}) or len(outer) > 1
        for i in outer[1:] + rest:
            names[i], beside[i] = (top + 1 + i, _SCALAR), node if node in own else 0
    T = _basis(len(dofs), blocks) if blocks else None
    for node, clamp in own.items():
        if clamp is not None and T is not None:
            T = T @ _rotations(node, clamp, places, names, held)
    T = _turned(T, names, axes, held) if axes else T
    return Rows(T, names, {k: v for k, v in held.items() if k[0] in own}, beside, middle, follows, dofs)


def _turned(T: Matrix | None, names: np.ndarray, axes: dict[int, np.ndarray], held: dict) -> Matrix:
    """T with the motions of some nodes along axes of their own; those of which a constraint takes one cannot be held."""
    from scipy.sparse import lil_array

    n, at = len(names), {tuple(each): i for i, each in enumerate(names.tolist())}
    turn = lil_array((n, n))
    turn.setdiag(1.0)
    for node, R in axes.items():
        rows = [at.get((node, d)) for d in (1, 2, 3)]
        if None in rows:
            for d in (1, 2, 3):
                held.pop((node, d), None)
            continue
        for i, row in zip(rows, R, strict=True):
            for j, value in zip(rows, row, strict=True):
                turn[i, j] = value
    return turn.tocsr() if T is None else (T @ turn.tocsr()).tocsr()


def _points(dofs: np.ndarray) -> int:
    """How many rows stand before those of solids that were made of shells and beams: in the order of nodes and directions."""
    after = np.diff(dofs[:, 0] * 8 + dofs[:, 1]) <= 0
    return int(np.argmax(after)) + 1 if after.any() else len(dofs)


def _rotations(node: int, clamp: Clamp, places: dict, names: np.ndarray, held: dict):
    """Scales, as a diagonal (n, n), that make rotations theta of what faces at half of the thickness h move: e = h theta x normal.

    A rotation about the normal is none; the stretch of the thickness stays as it is, and free.
    """
    from scipy.sparse import diags_array

    scale = np.ones(len(names))
    for a in range(3):
        along = np.cross(np.eye(3)[a], np.eye(3)[clamp.axis]) * clamp.half
        held[node, 4 + a] = ()
        at = places.get((node, 1 + int(np.argmax(np.abs(along)))), ())
        if a != clamp.axis and len(at) in (2, 3):
            own = at[_OUTER.get(len(at), (0, 1))[1]]
            scale[own], names[own], held[node, 4 + a] = along.sum(), (node, 4 + a), (own,)
    return diags_array(scale)


def _basis(n: int, blocks: list[tuple[list[int], list[int]]]):
    """Mean m in the first of each block, e_k in the others: u_k = m + e_k, and u_0 = m - sum of e_k over those of the mean."""
    from scipy.sparse import coo_array

    row, col, value = list(range(n)), list(range(n)), [1.0] * n
    for outer, rest in blocks:
        first = outer[0]
        for i in outer[1:]:
            row += [i, first]
            col += [first, i]
            value += [1.0, -1.0]
        for i in rest:
            row.append(i)
            col.append(first)
            value.append(1.0)
    return coo_array((value, (row, col)), shape=(n, n)).tocsr()
