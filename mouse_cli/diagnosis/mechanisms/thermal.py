"""Axial forces of all bars by one change of temperature."""

from mouse_cli.diagnosis.effects.thermal import recipes
from mouse_cli.diagnosis.mechanisms import Candidate

CANDIDATE = Candidate(
    "thermal",
    "axial forces by a change of temperature",
    "axial",
    "a frame that is warmer or colder than when it was built: the forces by which its bars keep one another from expanding, in "
    "equilibrium, all in proportion to one free expansion",
    recipes,
)
