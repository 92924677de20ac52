"""Supports of a mesh that act together: which, what they are called, and the deck with springs in them."""

from collections.abc import Sequence
from itertools import combinations

import numpy as np

from mouse_cli.diagnosis.extend.edit import Edit
from mouse_cli.model.diagnosis import Site
from mouse_cli.model.geometry import DIRECTIONS
from mouse_cli.model.mesh import Mesh
from mouse_cli.model.problem import Problem

TOGETHER = 16  # supports that may be alike
_FEW = 4  # nodes up to which a support may be flexible in any of its directions together
_ONE_ROW = 1e-6  # of the largest dimension: by which supports of one row are out of line at most

Held = tuple[int, int]  # node (index) and direction
Sets = list[list[int]]  # supports by number, those of each list with one stiffness


def support_sets(mesh: Mesh, held: Sequence[Held], size: np.ndarray) -> tuple[list[Sets], list[Sets]]:
    """Single supports, and those of one node in several directions; all of a direction, and of several, alike, and those of a
    row: what stands on one abutment, or on one side of a building. Of many nodes in the two directions of largest `size` (a,).
    """
    by = by_direction(held)
    at = {each: i for i, each in enumerate(held)}
    nodes = dict.fromkeys(node for node, _ in held)
    order = sorted(by, key=lambda d: -sum(size[by[d]].tolist()))
    together = [order[:2]] if len(nodes) > _FEW else [list(some) for n in (2, 3) for some in combinations(order, n)]
    together = [some for some in together if len(some) > 1]
    several = [
        [[at[node, d]] for d in some] for some in together for node in nodes if all((node, d) in at for d in some)
    ]
    many = {d: own for d, own in sorted(by.items()) if 1 < len(own) <= TOGETHER}
    alike = [[own] for own in many.values()]
    alike += [[many[d] for d in some] for some in together if all(d in many for d in some)]
    alike += [[own] for d in many for own in _rows(mesh, held, by[d])]
    return [[[i]] for i in range(len(held))] + several, alike


def _rows(mesh: Mesh, held: Sequence[Held], own: Sequence[int]) -> list[list[int]]:
    """Of supports `own` of one direction those of each row."""
    near = _ONE_ROW * float(np.ptp(mesh.coordinates, axis=0).max())
    return [[own[i] for i in row] for row in in_rows(mesh.coordinates[[held[i][0] for i in own]], near)]


def in_rows(x: np.ndarray, near: float) -> list[list[int]]:
    """Which of places x (k, 3), two or more, share a coordinate with one another, to `near`, and not with all."""
    found = set()
    for along in x.T:
        order = np.argsort(along, kind="stable")
        for row in np.split(order, np.flatnonzero(np.diff(along[order]) > near) + 1):
            if 1 < len(row) < len(x):
                found.add(tuple(sorted(row.tolist())))
    return [list(row) for row in sorted(found)]


def by_direction(held: Sequence[Held]) -> dict[int, list[int]]:
    """Numbers of supports by their direction."""
    found: dict[int, list[int]] = {}
    for i, (_, d) in enumerate(held):
        found.setdefault(d, []).append(i)
    return found


def support_site(problem: Problem, held: Sequence[Held], alike: bool = True) -> Site:
    """One support, or several."""
    ids = tuple(dict.fromkeys(int(problem.mesh.node_ids[node]) for node, _ in held))
    direction = " and ".join(dict.fromkeys(DIRECTIONS[d] for _, d in held))
    if len(ids) > 1:
        how = "all alike" if alike else "each with a stiffness of its own"
        return Site("node", ids, None, f"the supports of nodes {', '.join(map(str, ids))}, {direction}, {how}")
    position = tuple(problem.mesh.coordinates[held[0][0]].tolist())
    return Site("node", ids, position, f"the support of node {ids[0]}, {direction}")


def dofs(problem: Problem, sets: list[list[Held]]) -> tuple[str, ...]:
    """Names of supports, one a set; empty where some are alike."""
    single = all(len(held) == 1 for held in sets)
    return tuple(f"{problem.mesh.node_ids[node]}{DIRECTIONS[d]}" for held in sets for node, d in held) if single else ()


def stiffness_name(problem: Problem, sets: list[list[Held]], i: int) -> str:
    """What the stiffness of a set is called: one of several by its node, its direction, or both."""
    if len(sets) == 1:
        return "stiffness of the support"
    node, d = sets[i][0]
    by_node = f" of node {problem.mesh.node_ids[node]}" if len({tuple(n for n, _ in held) for held in sets}) > 1 else ""
    by_direction = f", {DIRECTIONS[d]}" if len({held[0][1] for held in sets}) > 1 else ""
    return f"stiffness of the support{by_node}{by_direction}"


def unit_of(direction: int) -> str:
    """Unit of the stiffness of a support along a direction, or about it."""
    return "N m/rad" if direction >= 3 else "N/m"


def sprung(
    problem: Problem, known: Problem, sets: list[list[Held]], values: np.ndarray, released: bool
) -> Problem:
    """The deck with springs of `values`, one a set of supports of `known`; released: in their place, else in addition to them."""
    edit = Edit(problem)
    for held, value in zip(sets, values, strict=True):
        nodes = [edit.index(int(known.mesh.node_ids[node])) for node, _ in held]
        d = held[0][1]
        if released:
            edit.supports = [each for each in edit.supports if each not in {(node, d) for node in nodes}]
        springs = edit.add("spring", [[node] for node in nodes], {DIRECTIONS[d]: value})
        edit.bind(f"stiffness of {support_site(known, held).text}", springs, (DIRECTIONS[d],), unit=unit_of(d))
    return edit.done()
