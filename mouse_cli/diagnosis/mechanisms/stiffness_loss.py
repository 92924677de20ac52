"""A part that is softer than the model says: a stretch of a bar, another element, a spring of a model of matrices."""

from dataclasses import replace

import numpy as np

from mouse_cli.diagnosis.effects.change import Recipe
from mouse_cli.diagnosis.effects.losses import of_elements, of_springs
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.mechanisms import Candidate
from mouse_cli.diagnosis.sites.stretches import in_both_planes, of_lines


def recipes(model: Reduced, candidate: Candidate) -> list[Recipe]:
    """F (1 + d) over a stretch of a line, in one plane or both; K_e (1 - d) of an element or of its direction; K - k b b' of a
    spring of matrices.
    """
    others = of_elements(model, candidate, directed=True) + of_springs(model, candidate)
    kinds = [each for each in (of_lines(model, candidate), in_both_planes(model, candidate), others) if each]
    share = -float(np.log(max(len(kinds), 1)))
    return [replace(recipe, log_prior=recipe.log_prior + share) for kind in kinds for recipe in kind]


CANDIDATE = Candidate(
    "stiffness-loss",
    "a softer part",
    "local-stiffness",
    "a stretch of a bar, another element or a spring that is softer than modelled, an element in all of its directions or in "
    "one: damage, a weaker section, another material, a bearing that has come loose",
    recipes,
)
