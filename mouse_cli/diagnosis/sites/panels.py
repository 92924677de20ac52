"""Panels that two crossed diagonals may brace: four corners, each joined to the next by a member or by the ground."""

import numpy as np

from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.sites.members import upward
from mouse_cli.diagnosis.sites.pairs import ALONG, Pairs, apart, strained
from mouse_cli.model.diagnosis import Site
from mouse_cli.model.mesh import Mesh

MOST = 20  # panels that are fitted
_LEVEL = 1e-3  # of the height of the structure, within which a floor is level
_FLAT = 1e-3  # of the length of a diagonal: how far two may pass one another


def crossed(model: Reduced, found: Pairs) -> np.ndarray:
    """Pairs of `found` (x, 2) that are the two diagonals of one panel, the MOST first of which one is strained most."""
    own, rank = every(model, found).tolist(), np.empty(len(found), int)
    rank[strained(model, found)] = np.arange(len(found))
    return np.array(sorted(own, key=lambda two: (min(rank[two]), two)), int).reshape(-1, 2)[:MOST]


def level(model: Reduced, found: Pairs) -> dict[float, np.ndarray]:
    """Diagonals of all panels (x, 2) of each floor that lies level, by its height."""
    two = every(model, found)
    if not len(two):
        return {}
    mesh = model.problem.mesh
    up = upward(mesh)
    heights = mesh.coordinates[found.keys[two, :2], up].reshape(len(two), -1)
    flat = np.ptp(heights, axis=1) <= _LEVEL * np.ptp(mesh.coordinates[:, up])
    floors: dict[float, list[int]] = {}
    for i in np.flatnonzero(flat).tolist():
        floors.setdefault(round(float(heights[i, 0]), 3), []).append(i)
    return {height: two[own] for height, own in sorted(floors.items())}


def every(model: Reduced, found: Pairs) -> np.ndarray:
    """Pairs of `found` (x, 2) that are the two diagonals of one panel."""
    if model.motion is None or not len(found) or (found.keys[:, 2] != ALONG).any():
        return np.zeros((0, 2), int)
    mesh = model.problem.mesh
    number = {frozenset(key): i for i, key in enumerate(found.keys[:, :2].tolist())}
    beside = _neighbours(mesh, np.unique(found.keys[:, :2]))
    own = set()
    for (one, other), i in ((tuple(key), i) for key, i in number.items()):
        between = sorted(beside[one] & beside[other])
        for n, c in enumerate(between):
            others = (number.get(frozenset((c, d))) for d in between[n + 1 :])
            own |= {(min(i, j), max(i, j)) for j in others if j is not None}
    two = np.array(sorted(own), int).reshape(-1, 2)
    return two[_cross(mesh.coordinates[found.keys[two, :2]])]


def panel(mesh: Mesh, keys: np.ndarray) -> Site:
    """The panel of two diagonals, keys (2, 3), in words."""
    ids = mesh.node_ids[keys[:, :2]].tolist()
    middle = tuple(mesh.coordinates[keys[:, :2].ravel()].mean(axis=0).tolist())
    (a, b), (c, d) = ids
    return Site(
        "node", (a, b, c, d), middle, f"crossed, between nodes {a} and {b} and between nodes {c} and {d}, both alike"
    )


def _neighbours(mesh: Mesh, nodes: np.ndarray) -> dict[int, set[int]]:
    """Nodes of `nodes` (indices) that one member, or the ground, joins to each of them."""
    one, other = np.triu_indices(len(nodes), 1)
    keys = np.column_stack([nodes[one], nodes[other]])
    held = np.isin(keys, _grounded(mesh)).all(axis=1)
    beside: dict[int, set[int]] = {int(node): set() for node in nodes}
    for a, b in keys[held | (apart(mesh, keys) == 1)].tolist():
        beside[a].add(b), beside[b].add(a)
    return beside


def _grounded(mesh: Mesh) -> np.ndarray:
    """Nodes (indices) that move in no direction in which any is held: what guides them alone joins them to nothing."""
    moving = mesh.standing[mesh.standing[:, 1] < 3]
    nodes, held = np.unique(moving[:, 0], return_counts=True)
    return nodes[held == held.max(initial=0)]


def _cross(ends: np.ndarray) -> np.ndarray:
    """Mask (x,) of the pairs of lines, ends (x, 2, 2, 3), that meet between their ends."""
    (u, v), between = (ends[:, i, 1] - ends[:, i, 0] for i in (0, 1)), ends[:, 1, 0] - ends[:, 0, 0]
    dot = lambda a, b: np.einsum("xi,xi->x", a, b)
    uu, uv, vv, uw, vw = dot(u, u), dot(u, v), dot(v, v), dot(u, between), dot(v, between)
    det = uu * vv - uv**2
    parallel = det <= 1e-12 * uu * vv
    det = np.where(parallel, 1.0, det)
    s, t = (uw * vv - uv * vw) / det, (uv * uw - uu * vw) / det
    off = np.linalg.norm(s[:, None] * u - t[:, None] * v - between, axis=1)
    return ~parallel & (s > 0) & (s < 1) & (t > 0) & (t < 1) & (off < _FLAT * np.sqrt(uu))
