"""What rival sites of one mechanism have in common: a wall, a storey, a line, a node."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from mouse_cli.model.mesh import Mesh
from mouse_cli.model.site import Site

_NEAR = 0.05  # of that dimension: within which sites are at one place
_SAME = 1e-6  # of the largest dimension of the structure: within which coordinates are the same


@dataclass(frozen=True)
class SharedPlace:
    """extents: axis (`x`, `y` or `z`), from and to, in m, of those along which all sites reach alike; nodes (ids) that all touch.

    An axis along which the whole structure reaches no further says nothing, and is left out.
    """

    extents: tuple[tuple[str, float, float], ...] = ()
    nodes: tuple[int, ...] = ()


def shared_place(mesh: Mesh | None, sites: Sequence[Site]) -> SharedPlace | None:
    """What `sites` share; None where that is nothing, or one of them is neither nodes nor elements."""
    found = [None if mesh is None else _nodes(mesh, site) for site in sites]
    if len(found) < 2 or any(each is None for each in found):
        return None
    at = np.array([[mesh.coordinates[own].min(axis=0), mesh.coordinates[own].max(axis=0)] for own in found])
    low, high = mesh.coordinates.min(axis=0), mesh.coordinates.max(axis=0)
    near = _SAME * max(float((high - low).max()), 1e-300)
    extents = tuple(
        ("xyz"[d], float(at[0, 0, d]), float(at[0, 1, d]))
        for d in range(3)
        if np.ptp(at[:, :, d], axis=0).max() <= near and high[d] - low[d] > at[0, 1, d] - at[0, 0, d] + near
    )
    nodes = tuple(int(mesh.node_ids[i]) for i in sorted(set.intersection(*map(set, found))))
    return SharedPlace(extents, nodes) if extents or nodes else None


def at_one_place(mesh: Mesh | None, sites: Sequence[Site]) -> bool:
    """Whether several sites, each a point or a node, are so near to each other that one look at the structure sees all of them."""
    if mesh is None or len(sites) < 2:
        return False
    points = [_point(mesh, site) for site in sites]
    if any(point is None for point in points):
        return False
    return bool(np.ptp(points, axis=0).max() <= _NEAR * np.ptp(mesh.coordinates, axis=0).max())


def _point(mesh: Mesh, site: Site) -> np.ndarray | None:
    """Coordinates (3,) of a site; None where it is no one point."""
    own = _nodes(mesh, site) if site.kind == "node" and site.position is None else None
    if site.position is not None:
        return np.array(site.position)
    return mesh.coordinates[own[0]] if own and len(own) == 1 else None


def panels(mesh: Mesh | None, sites: Sequence[Site]) -> bool:
    """Whether sites are a panel, or panels in a row: in one plane, where they reach alike, and less far than the structure, along
    an axis of it.
    """
    shared = shared_place(mesh, sites)
    if shared is None:
        return False
    size = np.ptp(mesh.coordinates, axis=0)
    near = _SAME * size.max()
    flat = [high - low <= near for _, low, high in shared.extents]
    return not all(flat) and sum(flat) >= int((size > near).sum()) - 2


def together(mesh: Mesh, sites: Sequence[Site]) -> Site:
    """The nodes that any of several sites touches, as one site."""
    touched = {i for site in sites for i in _nodes(mesh, site) or ()}
    return Site("node", tuple(int(mesh.node_ids[i]) for i in sorted(touched)))


def _nodes(mesh: Mesh, site: Site) -> list[int] | None:
    """Nodes (indices) of a site; None where it has none."""
    ids = [i for i in site.ids if not isinstance(i, str)]
    if site.kind == "node":
        found = np.flatnonzero(np.isin(mesh.node_ids, ids))
    elif site.kind == "element":
        own = [each.nodes[np.isin(each.ids, ids)].ravel() for each in mesh.elements]
        found = np.unique(np.concatenate(own)) if own else np.zeros(0, int)
    else:
        return None
    return found.tolist() if len(found) else None
