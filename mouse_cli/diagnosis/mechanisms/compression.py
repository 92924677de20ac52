"""Compression of a straight row of bars."""

from mouse_cli.diagnosis.effects.change import Recipe
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.mechanisms import Candidate
from mouse_cli.diagnosis.sites.preload import preloads
from mouse_cli.diagnosis.sites.reasons import bars


def recipes(model: Reduced, candidate: Candidate) -> list[Recipe]:
    """K - T times the integral of w' w'."""
    return preloads(model, candidate, -1)


CANDIDATE = Candidate(
    "compression",
    "axial compression",
    "axial",
    "a push along bars (thermal, dead load, prestress) that softens their bending: low modes fall most; it stays below buckling",
    recipes,
    bars,
)
