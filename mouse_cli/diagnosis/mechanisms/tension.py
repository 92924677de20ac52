"""Tension of a straight row of bars."""

from mouse_cli.diagnosis.effects.change import Recipe
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.mechanisms import Candidate
from mouse_cli.diagnosis.sites.preload import preloads
from mouse_cli.diagnosis.sites.reasons import bars


def recipes(model: Reduced, candidate: Candidate) -> list[Recipe]:
    """K + T times the integral of w' w'."""
    return preloads(model, candidate, 1)


CANDIDATE = Candidate(
    "tension",
    "axial tension",
    "axial",
    "a pull along bars (thermal, cable, prestress) that stiffens their bending: low modes rise most, high ones hardly",
    recipes,
    bars,
)
