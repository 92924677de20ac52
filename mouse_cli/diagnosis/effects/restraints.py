"""Supports that resist a turn which the model lets go: springs against rotations of supported nodes.

Springs k on rotations b of the nodes add b' (1/k + R)^-1 b to the coordinates, R (c, c) the residual flexibility of the structure
against moments there, which coordinates of a large model leave out (see `sites/residual.py`) and those of a small one do not.
"""

from dataclasses import dataclass

import numpy as np

from mouse_cli.diagnosis.effects.change import Change, Recipe, Unknown, product, steps
from mouse_cli.diagnosis.effects.support_sets import dofs, sprung, stiffness_name, support_sets, support_site
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.likelihoods.modal.scales import lowest
from mouse_cli.diagnosis.mechanisms import Candidate
from mouse_cli.diagnosis.sites.attached import flexibility
from mouse_cli.model.mesh import Mesh

_TURNED = 0.02  # share of the largest turn of a support in a measured mode below which one takes no part
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
    """A recipe for each rotation that a supported node is free in, for a row and for all alike, and for the two that turn most."""
    found = turns(model)
    if found is None:
        return []
    single, alike = support_sets(model.problem.mesh, found.free, found.size)
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


def _recipe(model: Reduced, candidate: Candidate, found: Turns, sets: list[list[int]], share: float) -> Recipe:
    """sets: rotations by number, those of each list with one stiffness."""
    which = [i for own in sets for i in own]
    turned = [[found.free[i] for i in own] for own in sets]
    k = [
        Unknown(stiffness_name(model.problem, turned, i), "N m/rad", *_range(model, found, own))
        for i, own in enumerate(sets)
    ]
    rows, R = found.rows[which], found.residual[np.ix_(which, which)]
    number = np.repeat(np.arange(len(sets)), [len(own) for own in sets])
    site = support_site(model.problem, [found.free[i] for i in which])
    change = lambda values: Change(K=rows.T @ np.linalg.solve(np.diag(1 / values[number]) + R, rows))
    extend = lambda problem, values: sprung(problem, model.problem, turned, values, released=False)
    own = dofs(model.problem, turned)
    grid = product(*(steps(each, 6 if len(sets) == 1 else 4) for each in k))
    return Recipe(candidate, tuple(k), change, grid, lambda values: site, log_prior=share, extend=extend, dofs=own)


def _range(model: Reduced, found: Turns, own: list[int]) -> tuple[float, float]:
    """By the stiffness of the structure itself against the turns, as its coordinates have it."""
    soft = found.rows[own] ** 2 @ (1 / np.maximum(model.eigenvalues, lowest(model))) + np.diag(found.residual)[own]
    return _SLIGHT / float(soft.mean()), _FIXED / float(soft.mean())
