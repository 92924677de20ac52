"""Shear flexibility of bars, after Timoshenko, without the inertia of sections that turn."""

from mouse_cli.diagnosis.effects.change import Recipe
from mouse_cli.diagnosis.effects.shearing import sheared
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.mechanisms import Candidate
from mouse_cli.diagnosis.sites.reasons import bars


def recipes(model: Reduced, candidate: Candidate) -> list[Recipe]:
    """phi = 12 EI / (kappa G A l^2) of every bar, from E / (kappa G)."""
    return sheared(model, candidate, turning=False)


CANDIDATE = Candidate(
    "shear",
    "shear flexibility",
    "shear",
    "shear flexibility of bars (Timoshenko): frequencies of high modes fall with the square of their wave number, low ones stay",
    recipes,
    bars,
)
