"""A point mass of the deck whose centre is not at its node: a floor that twists as it sways."""

import numpy as np

from mouse_cli.diagnosis.effects.arms import arm, arms, at_end, offset, with_arm
from mouse_cli.diagnosis.effects.change import Change, Recipe
from mouse_cli.diagnosis.effects.losses import matrices_of
from mouse_cli.diagnosis.extend.edit import Edit
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.mechanisms import Candidate
from mouse_cli.diagnosis.sites.attached import attached
from mouse_cli.diagnosis.sites.points import wanted
from mouse_cli.model.diagnosis import Site
from mouse_cli.model.problem import Problem

_MOST = 24  # items that are looked at one by one: those whose mass turns most


def recipes(model: Reduced, candidate: Candidate) -> list[Recipe]:
    """M + m (B'B - T'T), B = T + R x a: those of one entry of the deck alike, and each alone."""
    if model.motion is None:
        return []
    items = _items(model)
    sets = [[one for one in items if one[0] == s] for s in sorted({one[0] for one in items})]
    order = np.argsort([-one[4] for one in items], kind="stable")[:_MOST]
    chosen = [alike for alike in sets if len(alike) > 1] + [[items[i]] for i in sorted(order)]
    return [_recipe(model, candidate, own, len(sets) + len(items)) for own in chosen]


def _items(model: Reduced) -> list[tuple]:
    """Set, member, node (index), mass and how much of it a turn by arms moves, of each point mass whose node turns."""
    mesh, keep, found = model.problem.mesh, wanted(model), []
    count = model.low_modes(2)
    for s, members in enumerate(mesh.elements):
        if members.type != "mass":
            continue
        for i, M in enumerate(matrices_of(model, s)["M"]):
            node = int(members.nodes[i, 0])
            if M[0, 0] > 0 and (keep is None or keep[node]) and arms(model, node)[0]:
                found.append((s, i, node, float(M[0, 0]), float(M[0, 0] * np.abs(model.node(node)[3:, :count]).max())))
    return found


def _recipe(model: Reduced, candidate: Candidate, own: list[tuple], count: int) -> Recipe:
    mesh = model.problem.mesh
    unknowns, grid, axes = arms(model, own[0][2])
    alone = attached(model, [own[0][2]])[0] if len(own) == 1 else None
    off = offset(mesh.elements[own[0][0]])
    rows = [(model.node(node) if alone is None else alone.rows, m) for _, _, node, m, _ in own]
    still = sum(m * B.T @ B for B, m in ((at_end(model, u, off), m) for u, m in rows))
    ids = tuple(int(mesh.elements[s].ids[i]) for s, i, *_ in own)
    position = tuple(mesh.coordinates[own[0][2]].tolist()) if len(own) == 1 else None
    site = Site("element", ids, position, f"mass{'es' if len(ids) > 1 else ''} {', '.join(map(str, ids))}")

    def change(values: np.ndarray) -> Change:
        moved = [(at_end(model, u, off + arm(values, axes)), m) for u, m in rows]
        M = sum(m * B.T @ B for B, m in moved) - still
        return Change(M=M) if alone is None else Change(K=alone.K, M=alone.with_mass(M), sensing=alone.sensing)

    def extend(problem: Problem, values: np.ndarray) -> Problem:
        edit = Edit(problem)
        for number in ids:
            element = edit.element(number)
            end = with_arm(edit, int(edit.sets[element[0]].nodes[element[1], 0]), arm(values, axes))
            edit.move_to(element, end)
        return edit.done()

    log_prior = -float(np.log(count))
    extra = 0 if alone is None else alone.own
    return Recipe(candidate, unknowns, change, grid, lambda values: site, extra, log_prior=log_prior, extend=extend)


CANDIDATE = Candidate(
    "item-offset",
    "point masses off their nodes",
    "offset",
    "a point mass of the deck, or all of one entry, whose centre is not where the deck has it, such as a floor that twists because "
    "its mass is off the axis: M + m (B'B - T'T), B = T + R x a for translations T and rotations R of the node",
    recipes,
)
