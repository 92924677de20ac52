"""A set of elements of another material than modelled: its stiffness and its mass change, each by a factor of its own."""

from dataclasses import replace

import numpy as np

from mouse_cli.diagnosis.effects.change import Recipe
from mouse_cli.diagnosis.effects.element_sets import remade
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.mechanisms import Candidate

_SELDOM = 0.1  # how often a part is of another material beside how often any other cause is there: wear and accident change none


def recipes(model: Reduced, candidate: Candidate) -> list[Recipe]:
    """(a - 1) K_s and (b - 1) M_s of each element set."""
    seldom = float(np.log(_SELDOM))
    return [replace(each, log_prior=each.log_prior + seldom, seldom=seldom) for each in remade(model, candidate)]


CANDIDATE = Candidate(
    "material",
    "a part of another material",
    "material",
    "an element set whose stiffness and mass are other than modelled, each by a factor of its own: steel instead of aluminium, a "
    "plastic part, a laminate of other plies; where both fall alike it is a softer member; a priori ten times less probable than "
    "any other mechanism",
    recipes,
    plain="member",
)
