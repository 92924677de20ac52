"""A support that holds along a direction in which the model lets it slide, at a point beside its node: a bearing below the axis."""

import numpy as np

from mouse_cli.diagnosis.effects.arms import with_arm
from mouse_cli.diagnosis.effects.change import Change, Recipe, Unknown, product, steps
from mouse_cli.diagnosis.effects.restraints import turns
from mouse_cli.diagnosis.extend.edit import Edit
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.likelihoods.modal.scales import lowest, span, total_mass
from mouse_cli.diagnosis.mechanisms import Candidate
from mouse_cli.diagnosis.sites.attached import flexibility
from mouse_cli.diagnosis.sites.reasons import turning
from mouse_cli.model.diagnosis import Site
from mouse_cli.model.geometry import DIRECTIONS
from mouse_cli.model.problem import Problem

_LONGEST = 0.1  # of the structure
_SOFTEST, _STIFFEST = 1e-2, 1e4  # times total mass times the lowest eigenvalue
_BEGIN = (0.1, 0.5)  # arms over the longest from which a search begins, to either side


def recipes(model: Reduced, candidate: Candidate) -> list[Recipe]:
    """K + k b'b, b = (u + theta x a) n: n along a free translation of a support, the arm a across n and the axis of a turn."""
    found = turns(model)
    if found is None:
        return []
    mesh = model.problem.mesh
    held = {(node, d) for node, d in mesh.supports.tolist()}
    slides = [
        (node, d, turn - 3)
        for node, turn in found.free
        for d in mesh.directions
        if d < 3 and d != turn - 3 and (node, d) not in held
    ]
    return [_recipe(model, candidate, *each, -float(np.log(len(slides)))) for each in slides]


def _recipe(model: Reduced, candidate: Candidate, node: int, d: int, about: int, log_prior: float) -> Recipe:
    """d: number of the translation; about: axis of the turn."""
    scale, longest = lowest(model) * total_mass(model), _LONGEST * span(model)
    k = Unknown("stiffness of the bearing", "N/m", _SOFTEST * scale, _STIFFEST * scale)
    arm = Unknown(f"arm along {'XYZ'[3 - d - about]}", "m", -longest, longest, log=False)
    vector = np.eye(3)[3 - d - about]
    own = model.node(node)[[d, 3 + about]]
    lever = float((np.cross(np.eye(3)[about], vector))[d])
    R = flexibility(model, ((node, d), (node, 3 + about)), own)
    number = int(model.problem.mesh.node_ids[node])
    at = tuple(model.problem.mesh.coordinates[node].tolist())
    site = Site("node", (number,), at, f"beside the support of node {number}, {DIRECTIONS[d]}")

    def change(values: np.ndarray) -> Change:
        w = np.array([1.0, lever * values[1]])
        b = w @ own
        return Change(K=np.outer(b, b) / (1 / values[0] + w @ R @ w))

    def extend(problem: Problem, values: np.ndarray) -> Problem:
        edit = Edit(problem)
        end = with_arm(edit, edit.index(number), values[1] * vector)
        spring = edit.add("spring", [[end]], {DIRECTIONS[d]: values[0]})
        edit.bind(f"bearing {site.text}", spring, (DIRECTIONS[d],), unit="N/m")
        return edit.done()

    begin = longest * np.array([sign * share for share in _BEGIN for sign in (-1, 1)])
    grid = product(steps(k, 4), begin)
    return Recipe(candidate, (k, arm), change, grid, lambda values: site, log_prior=log_prior, extend=extend)


CANDIDATE = Candidate(
    "eccentric-bearing",
    "a bearing that holds beside the axis",
    "ground-spring",
    "a sliding bearing that has seized, a girder whose bearings lie below its axis, a stop at a flange: K + k b'b for the motion b "
    "of a point beside a support, on an arm across the direction in which it holds; the further off, the more it resists turning",
    recipes,
    turning,
    lasting=True,
)
