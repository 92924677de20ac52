"""Springs and joints in a row, of which several next to one another act as one.

Piles that scour has laid bare, a void under sleepers, a seam whose bolts are loose over some length.
"""

import numpy as np

from mouse_cli.model.mesh import Mesh

Member = tuple[int, int]  # number of a set, and in it

_TYPES = ("spring", "joint")
_LEAST, _LONGEST = 4, 40  # in a row, and in a run
_ON_LINE = 1e-6  # distance from a line, over the extent of the mesh, up to which a place is on it


def runs(mesh: Mesh, members: list[Member]) -> list[tuple[Member, ...]]:
    """Two and more of `members` of one kind next to one another in a row, but not the whole of it nor more than _LONGEST, each
    run once.
    """
    kinds: dict[tuple, list[Member]] = {}
    for s, i in members:
        own = mesh.elements[s]
        if own.type in _TYPES:
            acts = tuple(sorted(name for name, values in own.properties.items() if values[i]))
            kinds.setdefault((own.type, acts), []).append((s, i))
    found: dict[tuple[Member, ...], None] = {}
    for own in kinds.values():
        places = np.array([mesh.coordinates[mesh.elements[s].nodes[i]].mean(axis=0) for s, i in own])
        for row in _rows(places, _ON_LINE * float(np.ptp(mesh.coordinates, axis=0).max())):
            for count in range(2, min(len(row), _LONGEST + 1)):
                found |= {tuple(own[j] for j in row[first : first + count]): None for first in range(len(row) - count + 1)}
    return list(found)


def _rows(places: np.ndarray, near: float) -> list[list[int]]:
    """Numbers of `places` (n, 3) that lie on one line, in order along it: on that of all, else on lines along the axes."""
    if len(places) < _LEAST:
        return []
    off = places - places.mean(axis=0)
    _, _, (along, *_) = np.linalg.svd(off)
    if np.linalg.norm(off - np.outer(off @ along, along), axis=1).max() <= near:
        return [np.argsort(off @ along, kind="stable").tolist()]
    found = []
    for axis in range(3):
        lines: dict[tuple, list[int]] = {}
        for j, place in enumerate(np.delete(places, axis, axis=1)):
            lines.setdefault(tuple(np.round(place / max(near, 1e-300)).tolist()), []).append(j)
        found += [sorted(line, key=lambda j: places[j, axis]) for line in lines.values() if len(line) >= _LEAST]
    return found
