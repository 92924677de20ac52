"""The inertia of sections that turn, after Rayleigh."""

from mouse_cli.diagnosis.effects.change import Recipe, Unknown, proportional
from mouse_cli.diagnosis.effects.shearing import rotary, slender, with_rotary
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.mechanisms import Candidate
from mouse_cli.diagnosis.sites.reasons import bars
from mouse_cli.model.diagnosis import EVERYWHERE


def recipes(model: Reduced, candidate: Candidate) -> list[Recipe]:
    """M + a times the integral of density I N_theta' N_theta; a = 1 is what the section itself has."""
    if not slender(model):
        return []
    factor = Unknown("times density I of the section", "1", 0.5, 30.0)
    extend = lambda problem, values: with_rotary(problem, values[0])
    return [proportional(candidate, factor, 4, EVERYWHERE, 0.0, extend, M=rotary(model))]


CANDIDATE = Candidate(
    "rotary-inertia",
    "rotary inertia",
    "shear",
    "inertia of sections that turn in bending (Rayleigh), about a third of what shear does; more than 1 times the section's own "
    "means heavy parts far from the axis",
    recipes,
    bars,
    lasting=True,
)
