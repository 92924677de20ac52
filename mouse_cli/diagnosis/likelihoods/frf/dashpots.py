"""Dashpots to the ground: they damp, and frequencies and real shapes cannot show them."""

import numpy as np

from mouse_cli.diagnosis.effects.change import Change, Recipe, Unknown
from mouse_cli.diagnosis.extend.points import with_dashpot
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.likelihoods.modal.scales import lowest, total_mass
from mouse_cli.diagnosis.mechanisms import Candidate
from mouse_cli.diagnosis.sites.points import directions, sized

_SIZES = 10


def dashpots(model: Reduced) -> list[Recipe]:
    """A dashpot to the ground at each place: C + c B'B, B the motion of the place in one direction."""
    scale = total_mass(model) * np.sqrt(lowest(model))
    c = Unknown("damping", "N s/m", 1e-4 * scale, 10 * scale)
    change = lambda sizes, B: Change(C=sizes[0] * B.T @ B)
    return sized(DASHPOT, directions(model), c, (_SIZES, _SIZES), change, with_dashpot)


DASHPOT = Candidate(
    "dashpot",
    "a dashpot to the ground",
    "damping",
    "viscous damping between one point and the surroundings (seal, cable, damper): C + c B'B; sought in FRFs only, which "
    "show it",
    lambda model, candidate: [],
)
