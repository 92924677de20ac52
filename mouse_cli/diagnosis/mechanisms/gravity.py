"""Weight that makes a structure softer against swaying."""

from mouse_cli.diagnosis.effects.change import Recipe
from mouse_cli.diagnosis.effects.gravity import self_weight
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.mechanisms import Candidate


def recipes(model: Reduced, candidate: Candidate) -> list[Recipe]:
    """K + Kg of the axial forces under weight; K - (g/h) sum M_above b b' for a row of springs."""
    return self_weight(model, candidate)


CANDIDATE = Candidate(
    "gravity",
    "gravity (P-delta)",
    "gravity",
    "the weight above each storey or column pushes it further over as it sways (P-delta): less stiffness, most of it below",
    recipes,
)
