"""Both that Euler and Bernoulli leave out: shear flexibility, and the inertia of sections that turn."""

from mouse_cli.diagnosis.effects.change import Recipe
from mouse_cli.diagnosis.effects.shearing import sheared
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.mechanisms import Candidate
from mouse_cli.diagnosis.sites.reasons import bars


def recipes(model: Reduced, candidate: Candidate) -> list[Recipe]:
    """Timoshenko's bar with rotary inertia from the section itself."""
    return sheared(model, candidate, turning=True)


CANDIDATE = Candidate(
    "timoshenko",
    "shear flexibility and rotary inertia",
    "shear",
    "Timoshenko's bar: shear flexibility together with the inertia of turning sections, which always come together",
    recipes,
    bars,
)
