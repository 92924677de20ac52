"""A mass on a rigid arm from a node: a tank on a bracket, a machine beside the axis of a floor."""

import numpy as np

from mouse_cli.diagnosis.effects.arms import arm, arms, at_end, turning, with_arm
from mouse_cli.diagnosis.effects.change import Change, Recipe, Unknown, steps
from mouse_cli.diagnosis.extend.edit import Edit
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.likelihoods.modal.scales import BODY, total_mass
from mouse_cli.diagnosis.mechanisms import Candidate
from mouse_cli.diagnosis.sites.attached import Attached
from mouse_cli.model.diagnosis import Site
from mouse_cli.model.problem import Problem

_SIZES = 3  # masses that every arm begins with


def recipes(model: Reduced, candidate: Candidate) -> list[Recipe]:
    """M + m B'B, B = T + R x a the motion of the end of an arm a: at ends of members and at nodes with point masses."""
    found, count = turning(model)
    return [_recipe(model, candidate, node, at, arms(model, node), count) for node, at in found]


def _recipe(model: Reduced, candidate: Candidate, node: int, at: Attached, about: tuple, count: int) -> Recipe:
    unknowns, starts, axes = about
    number, total = int(model.problem.mesh.node_ids[node]), total_mass(model)
    m = Unknown("mass", "kg", *(BODY * total))
    site = Site("node", (number,), tuple(model.problem.mesh.coordinates[node].tolist()), f"an arm from node {number}")

    def change(values: np.ndarray) -> Change:
        B = at_end(model, at.rows, arm(values[1:], axes))
        return Change(K=at.K, M=at.with_mass(values[0] * B.T @ B), sensing=at.sensing)

    def extend(problem: Problem, values: np.ndarray) -> Problem:
        edit = Edit(problem)
        end = with_arm(edit, edit.index(number), arm(values[1:], axes))
        edit.bind(f"mass on {site.text}", edit.add("mass", [[end]], {"mass": values[0]}), ("mass",), unit="kg")
        return edit.done()

    grid = np.hstack([np.repeat(steps(m, _SIZES), len(starts))[:, None], np.tile(starts, (_SIZES, 1))])
    log_prior = -float(np.log(count))
    return Recipe(
        candidate, (m, *unknowns), change, grid, lambda values: site, at.own, log_prior=log_prior, extend=extend
    )


CANDIDATE = Candidate(
    "eccentric-mass",
    "a lumped mass on an arm",
    "mass",
    "an added mass on a rigid arm from a node, such as a tank on a bracket or a machine far from the axis of a floor: M + m B'B, "
    "B = T + R x a for translations T and rotations R of the node, so that it couples translation and rotation",
    recipes,
    plain="mass",
)
