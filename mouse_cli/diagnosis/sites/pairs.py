"""Pairs of places that nothing joins yet: where a brace, a cable or a strut may act, and by which motion."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import combinations

import numpy as np

from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.likelihoods.modal.scales import lowest
from mouse_cli.diagnosis.sites.ends import ends, joined, laden
from mouse_cli.diagnosis.sites.knees import knees
from mouse_cli.diagnosis.sites.left_out import between
from mouse_cli.model.arrays import dense
from mouse_cli.model.diagnosis import Site
from mouse_cli.model.geometry import DIRECTIONS
from mouse_cli.model.mesh import Mesh

ALONG = -1  # direction of a pair that acts along the line from one to the other
MOST = 40  # pairs that are fitted
_KNEES = 0.25  # share of the prior of pairs that knee braces have
_STILL = 0.02  # share of the largest elongation in a measured mode below which a pair does not take part
_SPRINGS = 60  # degrees of freedom or nodes up to which a model of springs is looked at
_ENDS, _LOOKED = 600, 3000  # ends of members, and pairs of them, the closest first, that are looked at
_NOTHING = 1e-9  # of a member, for a piece of one that ends nowhere
_SIGHT = 1e-3  # of the distance: how near to the line a third node is in the way
_EACH = 256  # pairs worked on at once


@dataclass(frozen=True)
class Pairs:
    """keys (c, 3): nodes (indices), or degrees of freedom of a model of matrices, and a direction (0 to 5) or ALONG.

    rows (c, r): b, the motion of the second relative to the first in that direction. log_prior (c,): ln of the share of
    each in all that may act. flexibility (c,): b'(K - shift M)^-1 b of all degrees of freedom.
    """

    keys: np.ndarray
    rows: np.ndarray
    log_prior: np.ndarray
    flexibility: np.ndarray
    shift: float

    def __len__(self) -> int:
        return len(self.keys)

    def only(self, which: np.ndarray) -> "Pairs":
        """Some of them."""
        return Pairs(self.keys[which], self.rows[which], self.log_prior[which], self.flexibility[which], self.shift)

    def left(self, eigenvalues: np.ndarray) -> np.ndarray:
        """R (c,): what the lowest coordinates, of these eigenvalues (r,), leave of the flexibility, see `left_out.py`."""
        kept = self.rows[:, : len(eigenvalues)] ** 2 @ (1 / (eigenvalues - self.shift))
        return np.maximum(self.flexibility - kept, 0.0)


def chosen(model: Reduced, found: Pairs) -> Pairs:
    """Those of `found` that a first look over the data found worth fitting, or that the measured modes strain most."""
    if model.ties is not None:
        number = {tuple(key): i for i, key in enumerate(found.keys.tolist())}
        return found.only(np.array([number[key] for key in model.ties if key in number], int))
    return found.only(np.sort(strained(model, found)[:MOST]))


def strained(model: Reduced, found: Pairs) -> np.ndarray:
    """Their order, those first that take most of the energy of a measured mode when they are there."""
    count = _count(model)
    scale = np.maximum(model.eigenvalues[:count], 1e-9 * model.eigenvalues[-1])
    return np.argsort(-(found.rows[:, :count] ** 2 / scale).max(axis=1, initial=0.0), kind="stable")


def pairs(model: Reduced) -> Pairs:
    """Ends of members and point masses in sight of one another, and places of knee braces; in a row of springs all that are not
    neighbours.

    Along a straight line of bars nothing is in sight but the neighbour: a beam has none.
    """
    if model.motion is None:
        keys, rows = _uncoupled(model)
    else:
        keys, rows = _between_ends(model)
    size = np.abs(rows[:, : _count(model)]).max(axis=1, initial=0.0)
    kept = np.flatnonzero(size > _STILL * size.max(initial=0.0))
    keys, rows = keys[kept], rows[kept]
    return Pairs(keys, rows, _log_prior(model, keys), *_flexibility(model, keys, rows))


def _log_prior(model: Reduced, keys: np.ndarray) -> np.ndarray:
    """See `Pairs`: even over the logarithm of how many pairs are no more members apart, for braces cross a panel, and seldom a
    building; any panel, be its bay short or long. Knee braces have a share of their own, each as much of it as the other.
    """
    if model.motion is None or not len(keys):
        return np.full(len(keys), -np.log(max(len(keys), 1)))
    mesh = model.problem.mesh
    knee = ~np.isin(keys[:, :2], _own(mesh)).all(axis=1)
    members = apart(mesh, keys[~knee])
    nearer = np.searchsorted(np.sort(members), members, side="right")
    share = _KNEES if knee.any() and not knee.all() else float(knee.all())
    found = np.full(len(keys), np.log(max(share, 1e-300) / max(knee.sum(), 1)))
    found[~knee] = np.log1p(-share) - np.log(nearer) - np.log((1 / nearer).sum()) if len(nearer) else 0.0
    return found


def _own(mesh: Mesh) -> np.ndarray:
    """Nodes (indices) between any two of which something may act: ends of members and point masses."""
    return np.union1d(ends(mesh), laden(mesh))


def apart(mesh: Mesh, keys: np.ndarray) -> np.ndarray:
    """Members (c,) on the shortest way from one node of a pair to the other, however many elements one is made of.

    Of each element half a member is at each of its nodes at which members end.
    """
    from scipy.sparse import csr_array
    from scipy.sparse.csgraph import dijkstra

    n, at_end = len(mesh.coordinates), np.isin(np.arange(len(mesh.coordinates)), ends(mesh))
    one, other = np.array(sorted(joined(mesh)), int).reshape(-1, 2).T
    half = np.maximum(0.5 * at_end[one] + 0.5 * at_end[other], _NOTHING)
    start, row = np.unique(keys[:, 0], return_inverse=True)
    way = dijkstra(csr_array((half, (one, other)), shape=(n, n)), directed=False, indices=start)
    return np.round(way[row, keys[:, 1]])


def _flexibility(model: Reduced, keys: np.ndarray, rows: np.ndarray) -> tuple[np.ndarray, float]:
    """See `Pairs`, and the shift: that of all degrees of freedom of a large model, where it is known."""
    found = _moved(model, keys)
    if found is None:
        shift = -0.3 * lowest(model)
        return rows**2 @ (1 / (model.eigenvalues - shift)), shift
    axis = _axes(model.problem.mesh, keys)
    every = np.arange(len(keys))
    return np.einsum("ci,cij,cj->c", axis, found(every, every), axis), model.static.shift


def _moved(model: Reduced, keys: np.ndarray) -> Callable[[np.ndarray, np.ndarray], np.ndarray] | None:
    """C(p, q) (c, 3, 3): what unit forces between the nodes of pairs q (c,) of `keys` move those of p (c,) apart; None: unknown."""
    ends, at = np.unique(keys[:, :2], return_inverse=True)
    moved = None if model.motion is None or not len(keys) else between(model.static, ends)
    if moved is None:
        return None
    C = moved.reshape(len(ends), 3, len(ends), 3).transpose(0, 2, 1, 3)
    one, other = at.reshape(-1, 2).T
    return lambda p, q: C[one[p], one[q]] + C[other[p], other[q]] - C[one[p], other[q]] - C[other[p], one[q]]


def left_together(model: Reduced, found: Pairs, which: np.ndarray) -> np.ndarray:
    """R (x, 2, 2) of two pairs each, `which` (x, 2) of `found`: what coordinates leave of the flexibility, see `Pairs.left`."""
    R = np.zeros((len(which), 2, 2))
    R[:, [0, 1], [0, 1]] = found.left(model.eigenvalues)[which]
    moved = _moved(model, found.keys)
    if moved is not None:
        p, q = which.T
        axis = _axes(model.problem.mesh, found.keys)
        kept = (found.rows[p] * found.rows[q]) @ (1 / (model.eigenvalues - found.shift))
        R[:, 0, 1] = R[:, 1, 0] = np.einsum("xi,xij,xj->x", axis[p], moved(p, q), axis[q]) - kept
    return R


def _axes(mesh: Mesh, keys: np.ndarray) -> np.ndarray:
    """Unit vectors (c, 3) along which pairs act."""
    along = mesh.coordinates[keys[:, 1]] - mesh.coordinates[keys[:, 0]]
    given = np.eye(3)[np.maximum(keys[:, 2], 0)]
    size = np.maximum(np.linalg.norm(along, axis=1, keepdims=True), 1e-300)
    return np.where(keys[:, 2:] == ALONG, along / size, given)


def site_of(model: Reduced, key: np.ndarray) -> Site:
    """A pair in words."""
    one, other, direction = key.tolist()
    if model.motion is None:
        labels = tuple(model.problem.structure.labels[i] for i in (one, other))
        return Site("dof", labels, None, f"between degrees of freedom {labels[0]} and {labels[1]}")
    mesh = model.problem.mesh
    ids = tuple(int(mesh.node_ids[i]) for i in (one, other))
    middle = tuple(mesh.coordinates[[one, other]].mean(axis=0).tolist())
    along = "" if direction == ALONG else f", {DIRECTIONS[direction]}"
    return Site("node", ids, middle, f"between nodes {ids[0]} and {ids[1]}{along}")


def _count(model: Reduced) -> int:
    return model.low_modes()


def _uncoupled(model: Reduced) -> tuple[np.ndarray, np.ndarray]:
    """Degrees of freedom of a model of springs that no spring joins; none where K is not made of springs."""
    K = dense(model.assembly.matrices(model.theta)[0]) if model.problem.structure.n <= _SPRINGS else np.ones((1, 1))
    off = K - np.diag(np.diag(K))
    if model.problem.structure.geometry is not None or (off > 1e-9 * np.abs(K).max()).any() or not off.any():
        return _none(model)
    one, other = np.nonzero(np.triu(off == 0, 1))
    return np.stack([one, other, np.full(len(one), ALONG)], axis=1), model.V[other] - model.V[one]


def _none(model: Reduced) -> tuple[np.ndarray, np.ndarray]:
    return np.zeros((0, 3), int), np.zeros((0, model.r))


def _between_ends(model: Reduced) -> tuple[np.ndarray, np.ndarray]:
    """Along the line between ends of members or point masses; in each direction where all nodes are in one row."""
    mesh = model.problem.mesh
    own, together = _own(mesh), joined(mesh)
    if not 2 < len(own) <= _ENDS:
        return _none(model)
    cut = knees(mesh, ends(mesh))
    found = np.union1d(own, np.array(sorted({node for pair in cut for node in pair}), int))
    if len(found) > _ENDS:
        cut, found = set(), own
    u = np.array([model.node(int(i))[:3] for i in found])
    xyz = mesh.coordinates[found]
    if np.linalg.matrix_rank(xyz - xyz[0], tol=1e-9 * _size(mesh)) < 2:
        return _none(model) if model.bars is not None or len(found) > _SPRINGS else _in_a_row(u, found, together)
    one, other = np.hstack([_nearest(mesh, found, *part) for part in _candidates(found, own, cut)])
    bare = [pair not in together for pair in zip(found[one].tolist(), found[other].tolist(), strict=True)]
    one, other = one[bare], other[bare]
    seen = _in_sight(mesh, found[one], found[other])
    one, other = one[seen], other[seen]
    axis = (xyz[other] - xyz[one]) / np.linalg.norm(xyz[other] - xyz[one], axis=1)[:, None]
    rows = np.einsum("cd,cdr->cr", axis, u[other] - u[one])
    return np.stack([found[one], found[other], np.full(len(one), ALONG)], axis=1), rows


def _candidates(found: np.ndarray, own: np.ndarray, cut: set[tuple[int, int]]) -> Iterator[tuple[np.ndarray, np.ndarray]]:
    """Indices among the nodes `found`: all pairs of `own`, and those that are `cut`, which push none of these out."""
    yield tuple(np.searchsorted(found, own[at]) for at in np.triu_indices(len(own), 1))
    more = np.array(sorted(cut - set(combinations(own.tolist(), 2))), int).reshape(-1, 2)
    yield tuple(np.searchsorted(found, more.T))


def _nearest(mesh: Mesh, found: np.ndarray, one: np.ndarray, other: np.ndarray) -> np.ndarray:
    """Those of the pairs of nodes, (2, c), that are apart, the closest."""
    distance = np.linalg.norm(mesh.coordinates[found[other]] - mesh.coordinates[found[one]], axis=1)
    order = np.argsort(distance, kind="stable")
    return np.array([one, other])[:, np.sort(order[distance[order] > 1e-6 * _size(mesh)][:_LOOKED])]


def _in_a_row(u: np.ndarray, nodes: np.ndarray, joined: set) -> tuple[np.ndarray, np.ndarray]:
    """Floors of a chain of storeys, or masses in a row, that are not neighbours; from a held one it is a spring to the ground."""
    free = np.flatnonzero(np.abs(u).max(axis=(1, 2)) > 0).tolist()
    own = [(i, j) for n, i in enumerate(free) for j in free[n + 1 :] if (int(nodes[i]), int(nodes[j])) not in joined]
    at = np.array([(i, j, d) for d in range(3) for i, j in own], int).reshape(-1, 3)
    keys = np.column_stack([nodes[at[:, 0]], nodes[at[:, 1]], at[:, 2]])
    return keys, u[at[:, 1], at[:, 2]] - u[at[:, 0], at[:, 2]]


def _size(mesh: Mesh) -> float:
    return float(np.ptp(mesh.coordinates, axis=0).max())


def _in_sight(mesh: Mesh, one: np.ndarray, other: np.ndarray) -> np.ndarray:
    """Mask of the pairs between which no third node is."""
    xyz, free = mesh.coordinates, np.ones(len(one), bool)
    for first in range(0, len(one), _EACH):
        own = slice(first, first + _EACH)
        start, along = xyz[one[own]], xyz[other[own]] - xyz[one[own]]
        to = xyz[None] - start[:, None]
        length = np.linalg.norm(along, axis=1)[:, None]
        share = np.einsum("cnd,cd->cn", to, along) / length**2
        off = np.linalg.norm(to - share[..., None] * along[:, None], axis=2)
        between = (off < _SIGHT * length) & (share > _SIGHT) & (share < 1 - _SIGHT)
        free[own] = ~between.any(axis=1)
    return free
