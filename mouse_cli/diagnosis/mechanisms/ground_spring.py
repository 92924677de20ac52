"""A spring from one place of the structure to the ground."""

import numpy as np

from mouse_cli.diagnosis.effects.change import Change, Recipe, Unknown
from mouse_cli.diagnosis.extend.points import with_spring
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.likelihoods.modal.scales import lowest, total_mass
from mouse_cli.diagnosis.mechanisms import Candidate
from mouse_cli.diagnosis.sites.points import directions, sized

_STARTS = 6, 18  # stiffnesses to begin from, along a line and at one place


def recipes(model: Reduced, candidate: Candidate) -> list[Recipe]:
    """K + k B'B, B the motion of a place in one direction."""
    scale = lowest(model) * total_mass(model)
    k = Unknown("stiffness", "N/m", 1e-3 * scale, 1e3 * scale)

    def change(sizes: np.ndarray, B: np.ndarray) -> Change:
        return Change(K=sizes[0] * B.T @ B)

    return sized(candidate, directions(model), k, _STARTS, change, with_spring)


CANDIDATE = Candidate(
    "ground-spring",
    "a spring to the ground",
    "ground-spring",
    "a support, cable or contact that ties one point to the surroundings: K + k B'B",
    recipes,
)
