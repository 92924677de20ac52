"""Places of knee braces: from one member to another that meets it in a corner, both within half of their length from there."""

from collections.abc import Iterator
from itertools import combinations

import numpy as np

from mouse_cli.diagnosis.sites.ends import STRAIGHT
from mouse_cli.model.mesh import Mesh

_HALF = 0.5  # of a member, as far as a knee brace reaches along it
_LEAN = 3.0  # ratio of its legs at most: what leans further is hardly a brace

Arm = tuple[np.ndarray, list[tuple[int, float]]]  # direction of a member from its corner; nodes within it, and how far they are


def knees(mesh: Mesh, ends: np.ndarray) -> set[tuple[int, int]]:
    """Pairs of nodes (i < j) within members that meet at one of `ends`, see above; a member of one element has none."""
    beams = [each.nodes for each in mesh.elements if each.type == "beam"]
    beside: dict[int, list[int]] = {}
    for a, b in np.concatenate(beams).tolist() if beams else ():
        beside.setdefault(a, []).append(b), beside.setdefault(b, []).append(a)
    stops, found = set(ends.tolist()), set()
    for corner in sorted(stops & set(beside)):
        arms = [arm for first in beside[corner] if (arm := _arm(mesh, beside, stops, corner, first))[1]]
        for one, other in combinations(arms, 2):
            if abs(float(one[0] @ other[0])) < STRAIGHT:
                found.update(_between(one, other))
    return found


def _arm(mesh: Mesh, beside: dict[int, list[int]], stops: set[int], corner: int, first: int) -> Arm:
    """The member that begins at a corner with a node beside it: its nodes up to half of its length."""
    before, at, own = corner, first, []
    away = lambda node: float(np.linalg.norm(mesh.coordinates[node] - mesh.coordinates[corner]))
    while at not in stops and len(beside[at]) == 2:
        own.append((at, away(at)))
        before, at = at, next(each for each in beside[at] if each != before)
    along = (mesh.coordinates[first] - mesh.coordinates[corner]) / max(away(first), 1e-300)
    return along, [(node, reach) for node, reach in own if reach <= _HALF * away(at)]


def _between(one: Arm, other: Arm) -> Iterator[tuple[int, int]]:
    for a, leg in one[1]:
        for b, its in other[1]:
            if leg <= _LEAN * its and its <= _LEAN * leg:
                yield min(a, b), max(a, b)
