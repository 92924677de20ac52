"""A spring from one place of the structure to the ground, in one direction or in all alike."""

from dataclasses import replace

import numpy as np

from mouse_cli.diagnosis.effects.change import Change, Recipe, Unknown
from mouse_cli.diagnosis.extend.edit import Edit
from mouse_cli.diagnosis.extend.places import node_at
from mouse_cli.diagnosis.extend.points import with_spring
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.likelihoods.modal.scales import lowest, total_mass
from mouse_cli.diagnosis.mechanisms import Candidate
from mouse_cli.diagnosis.sites.points import Points, directions, in_all_directions, sized
from mouse_cli.model.geometry import DIRECTIONS
from mouse_cli.model.problem import Problem

_STARTS = 6, 18  # stiffnesses to begin from, along a line and at one place
_ALIKE = 0.3  # prior probability that it acts in all directions alike


def recipes(model: Reduced, candidate: Candidate) -> list[Recipe]:
    """K + k B'B, B the motion of a place in one direction, or in all that the deck keeps."""
    scale = lowest(model) * total_mass(model)
    k = Unknown("stiffness", "N/m", 1e-3 * scale, 1e3 * scale)
    change = lambda sizes, B: Change(K=sizes[0] * B.T @ B)
    one, alike = directions(model), in_all_directions(model)
    share = np.log([1 - _ALIKE, _ALIKE] if alike else [1.0, 1.0])
    found = zip(share.tolist(), (one, alike), (with_spring, _with_springs), strict=True)
    return [
        replace(each, log_prior=each.log_prior + own)
        for own, points, extend in found
        for each in sized(candidate, points, k, _STARTS, change, extend)
    ]


def _with_springs(problem: Problem, point: Points, at: np.ndarray, k: float) -> Problem:
    edit, site = Edit(problem), point.site(at)
    along = tuple(DIRECTIONS[d] for d in point.dofs)
    spring = edit.add("spring", [[node_at(edit, site)]], dict.fromkeys(along, k))
    edit.bind(f"spring to the ground at {site.text}", spring, along, unit="N/m")
    return edit.done()


CANDIDATE = Candidate(
    "ground-spring",
    "a spring to the ground",
    "ground-spring",
    "a support, cable or contact that ties one point to the surroundings in one direction, or guys and mounts in all alike: "
    "K + k B'B",
    recipes,
)
