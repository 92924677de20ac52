"""Supports that resist a turn which the model lets go: springs against rotations of supported nodes.

Springs k on rotations b of the nodes add b' (1/k + R)^-1 b to the coordinates, R (c, c) the residual flexibility of the structure
against moments there, which coordinates of a large model leave out (see `sites/residual.py`) and those of a small one do not.
"""

from dataclasses import dataclass

import numpy as np

from mouse_cli.diagnosis.effects.change import Change, Recipe, Unknown, product, steps
from mouse_cli.diagnosis.extend.edit import Edit
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.likelihoods.modal.scales import lowest
from mouse_cli.diagnosis.mechanisms import Candidate
from mouse_cli.diagnosis.sites.attached import flexibility
from mouse_cli.model.diagnosis import Site
from mouse_cli.model.geometry import DIRECTIONS
from mouse_cli.model.mesh import Mesh
from mouse_cli.model.problem import Problem

_TURNED = 0.02  # share of the largest turn of a support in a measured mode below which one takes no part
_TOGETHER = 16  # supports that may resist alike
_MOST = 48  # supports that are looked at: those that turn most
_SLIGHT, _FIXED = 1e-2, 1e3  # times the stiffness of the structure itself against a turn there


@dataclass(frozen=True)
class Turns:
    """Rotations of c supports, (node, direction) in `free`: rows (c, r), R (c, c), and how much each turns, `size` (c,)."""

    free: tuple[tuple[int, int], ...]
    rows: np.ndarray
    residual: np.ndarray
    size: np.ndarray


def resisting(model: Reduced, candidate: Candidate) -> list[Recipe]:
    """A recipe for each rotation that a supported node is free in, for all alike, and for the two that turn most."""
    found = turns(model)
    if found is None:
        return []
    single, alike = _sets(found)
    recipes = []
    for kind in (single, alike):
        share = -float(np.log(len(kind) * (1 + bool(alike)))) if kind else 0.0
        recipes += [_recipe(model, candidate, found, sets, share) for sets in kind]
    return recipes


def turns(model: Reduced) -> Turns | None:
    """Those that the measured modes turn; None without any."""
    mesh = model.problem.mesh
    if model.motion is None:
        return None
    held = {(node, d) for node, d in mesh.supports.tolist()}
    count = model.low_modes()
    everywhere = _everywhere(mesh)
    own = sorted({node for node, d in held if d not in everywhere})
    free = [(node, d) for node in own for d in (3, 4, 5)
            if d in mesh.directions and (node, d) not in held]  # fmt: skip
    rows = np.array([model.node(node)[d] for node, d in free]).reshape(len(free), model.r)
    size = np.abs(rows[:, :count]).max(axis=1, initial=0.0)
    order = np.sort(np.argsort(-size, kind="stable")[:_MOST])
    order = order[size[order] > _TURNED * size.max(initial=0.0)]
    if not len(order):
        return None
    chosen = tuple(free[i] for i in order)
    return Turns(chosen, rows[order], flexibility(model, chosen, rows[order]), size[order])


def _everywhere(mesh: Mesh) -> set[int]:
    """Directions that every node of an element is held in: so a deck leaves them out, and no support is there."""
    nodes = np.unique(np.concatenate([each.nodes.ravel() for each in mesh.elements]))
    holds = lambda d: np.isin(nodes, mesh.supports[mesh.supports[:, 1] == d, 0]).all()
    return {d for d in range(6) if holds(d)}


def _sets(found: Turns) -> tuple[list[list[list[int]]], list[list[list[int]]]]:
    """Rotations by number that resist together, in lists of one stiffness each: of single nodes, and of all."""
    by: dict[int, list[int]] = {}
    for i, (_, d) in enumerate(found.free):
        by.setdefault(d, []).append(i)
    most = sorted(by, key=lambda d: -float(found.size[by[d]].sum()))[:2]
    at = {each: i for i, each in enumerate(found.free)}
    nodes = dict.fromkeys(node for node, _ in found.free)
    both = [[[at[node, d]] for d in most] for node in nodes if len(most) == 2 and all((node, d) in at for d in most)]
    many = {d: own for d, own in sorted(by.items()) if 1 < len(own) <= _TOGETHER}
    alike = [[own] for own in many.values()]
    if len(most) == 2 and all(d in many for d in most):
        alike.append([many[d] for d in most])
    return [[[i]] for i in range(len(found.free))] + both, alike


def _recipe(model: Reduced, candidate: Candidate, found: Turns, sets: list[list[int]], share: float) -> Recipe:
    """sets: rotations by number, those of each list with one stiffness."""
    which = [i for own in sets for i in own]
    k = [Unknown(_called(found, own, sets), "N m/rad", *_range(model, found, own)) for own in sets]
    rows, R = found.rows[which], found.residual[np.ix_(which, which)]
    number = np.repeat(np.arange(len(sets)), [len(own) for own in sets])
    site = _site(model.problem, [found.free[i] for i in which])

    def change(values: np.ndarray) -> Change:
        return Change(K=rows.T @ np.linalg.solve(np.diag(1 / values[number]) + R, rows))

    def extend(problem: Problem, values: np.ndarray) -> Problem:
        edit = Edit(problem)
        for own, value in zip(sets, values, strict=True):
            free = [found.free[i] for i in own]
            nodes = [edit.index(int(model.problem.mesh.node_ids[node])) for node, _ in free]
            direction = DIRECTIONS[free[0][1]]
            springs = edit.add("spring", [[node] for node in nodes], {direction: value})
            name = f"stiffness of {_site(model.problem, free).text}"
            edit.bind(name, springs, (direction,), unit="N m/rad")
        return edit.done()

    grid = product(*(steps(each, 6 if len(sets) == 1 else 4) for each in k))
    return Recipe(candidate, tuple(k), change, grid, lambda values: site, log_prior=share, extend=extend)


def _range(model: Reduced, found: Turns, own: list[int]) -> tuple[float, float]:
    """By the stiffness of the structure itself against the turns, as its coordinates have it."""
    soft = found.rows[own] ** 2 @ (1 / np.maximum(model.eigenvalues, lowest(model))) + np.diag(found.residual)[own]
    return _SLIGHT / float(soft.mean()), _FIXED / float(soft.mean())


def _called(found: Turns, own: list[int], sets: list[list[int]]) -> str:
    """What a stiffness is called."""
    return "stiffness of the support" + (f", {DIRECTIONS[found.free[own[0]][1]]}" if len(sets) > 1 else "")


def _site(problem: Problem, free: list[tuple[int, int]]) -> Site:
    ids = tuple(dict.fromkeys(int(problem.mesh.node_ids[node]) for node, _ in free))
    direction = " and ".join(dict.fromkeys(DIRECTIONS[d] for _, d in free))
    if len(ids) > 1:
        return Site("node", ids, None, f"the supports of nodes {', '.join(map(str, ids))}, {direction}, all alike")
    position = tuple(problem.mesh.coordinates[free[0][0]].tolist())
    return Site("node", ids, position, f"the support of node {ids[0]}, {direction}")
