"""What K and M lose without one of the sets, where quadratic shells stay that it met: the solver held their thickness there
(`knots`), and lets go. An export without the elements of the set tells, in which what is let go follows statically.
"""

import numpy as np

from mouse_cli._errors import DeckError
from mouse_cli.importing.calculix import Exported, Solver, cores
from mouse_cli.importing.jobs import export
from mouse_cli.importing.knots import let_go
from mouse_cli.importing.model import InputModel
from mouse_cli.importing.separate import Parts, difference
from mouse_cli.model.arrays import Matrix

_LARGE, _MOST = 50_000, 4000  # degrees of freedom of a model that is taken, and those that are let go
_OPEN = 1e-9  # of the largest element: what may differ where nothing is let go
_FAINT = 1e-9  # of the largest part of a motion that follows: what is none
_BLOCK = 512  # columns that are solved for at once


def losses(model: InputModel, found: Parts, solver: Solver) -> tuple[dict[int, tuple[Matrix, Matrix]], list[int]]:
    """By group (number) what K and M (n, n) lose without it, of those that hold others; and those for which it is not known."""
    held = let_go(model)
    if found.whole.K.shape[0] > _LARGE:
        return {}, list(held)
    jobs = {i: (export(model, gone=model.groups[i].elements), f"the whole without {model.groups[i].name}") for i in held}
    ahead = list(jobs.values())
    solver.begin(ahead[: cores() + 1])
    lost = {}
    for k, (i, nodes) in enumerate(held.items()):
        try:
            rest = _rest(model, found.whole, solver.matrices(*jobs[i], *model.known), nodes)
        except DeckError:  # a constraint that needs the set
            rest = None
        solver.begin(ahead[k + cores() + 1 : k + cores() + 2])
        each = None if rest is None else tuple(_lost(getattr(found.whole, x), own) for x, own in zip("KM", rest, strict=False))
        if each is not None and _elsewhere((each[0] - found.K[i]).tocoo(), rest[2]) <= _OPEN * abs(found.whole.K).max():
            lost[i] = each
    return lost, [i for i in held if i not in lost]


def _lost(whole: Matrix, rest: Matrix) -> Matrix:
    """What they differ by, as symmetric as it is but for rounding."""
    found = difference(whole, rest)
    return ((found + found.T) / 2).tocsr()


def _elsewhere(difference, near: np.ndarray) -> float:
    """The largest element with a row or column that is not `near`."""
    far = ~(near[difference.row] & near[difference.col])
    return float(np.abs(difference.data[far]).max(initial=0.0))


def _rest(model: InputModel, whole: Exported, other: Exported, nodes: set[int]) -> tuple[Matrix, Matrix, np.ndarray] | None:
    """K and M (n, n) of the export `other` in the coordinates of the whole, those let go at `nodes` following statically, but for
    what a support holds there; and which coordinates (n,) that touches. None where coordinates are not found again.
    """
    from scipy.sparse import coo_array
    from scipy.sparse.linalg import splu

    keys = [_keys(model, each) for each in (whole, other)]
    if None in keys:
        return None
    at = {key: i for i, key in enumerate(keys[0])}
    kept = [j for j, key in enumerate(keys[1]) if key in at]
    held = {j for support in model.supports for dof in support.dofs for j in other.rows.held.get(dof, ())}
    free = [j for j, key in enumerate(keys[1]) if key not in at and j not in held]
    if not free or len(free) > _MOST or any(other.rows.dofs[j, 0] not in nodes for j in free):
        return None
    into = np.array([at[keys[1][j]] for j in kept])
    factor, border = splu(other.K[free][:, free].tocsc()), other.K[free][:, kept].tocsc()
    felt = np.flatnonzero(np.diff(border.indptr))
    row, col, value = list(kept), into.tolist(), [1.0] * len(kept)
    near = np.zeros(len(keys[0]), bool)
    own = [i for i, key in enumerate(keys[0]) if key[1] in nodes]
    near[own] = near[whole.K[own].indices] = True
    for start in range(0, len(felt), _BLOCK):
        own = felt[start : start + _BLOCK]
        moved = -factor.solve(border[:, own].toarray())
        f, c = np.nonzero(np.abs(moved) > _FAINT * np.abs(moved).max(initial=0.0))
        row += [free[k] for k in f]
        col += into[own[c]].tolist()
        value += moved[f, c].tolist()
        near[into[own[c]]] = True
    T = coo_array((value, (row, col)), shape=(len(keys[1]), len(keys[0]))).tocsr()
    return (T.T @ other.K @ T).tocsr(), (T.T @ other.M @ T).tocsr(), near


def _keys(model: InputModel, exported: Exported) -> list[tuple] | None:
    """What each coordinate is, whatever else the model has: motions of nodes, those beside them, and rotations and stretch of nodes
    where shells meet, each as two nodes that the solver numbers in the order of these.
    """
    names, dofs, last = exported.rows.names.tolist(), exported.rows.dofs.tolist(), max(model.nodes)
    count: dict[tuple[int, int], int] = {}
    for dof in map(tuple, dofs):
        count[dof] = count.get(dof, 0) + 1
    inner = sorted({node for node, _ in dofs if node > last})
    single = {n for n, _ in dofs if n in model.layers and all(count.get((n, d)) == 1 for d in (1, 2, 3))}
    knotted = sorted(single - {node for node, _ in exported.rows.follows})
    if inner[1::2] != [turns + 1 for turns in inner[::2]] or len(inner) != 2 * len(knotted):
        return None
    owner = {inner[2 * k + own]: (node, own) for k, node in enumerate(knotted) for own in (0, 1)}
    found, seen = [], {}
    for (node, d), (raw, along) in zip(names, dofs, strict=True):
        seen[raw, along] = seen.get((raw, along), 0) + 1
        if raw > last:
            found.append(("turn", *owner[raw], along))
        else:
            found.append(("own", node, d) if d else ("beside", raw, along, seen[raw, along], count[raw, along]))
    return found

