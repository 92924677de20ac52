"""A rotationally flexible support: The support moves: psi = [-K_ff^-1 K_fs; 1] beside the model, with a spring against it."""

from functools import partial

from mouse_cli.diagnosis.effects.supports import yielding
from mouse_cli.diagnosis.mechanisms import Candidate
from mouse_cli.diagnosis.sites.reasons import supports

CANDIDATE = Candidate(
    "support-rotation",
    "a rotationally flexible support",
    "support",
    "a clamp of the model rotates with the moment (base plate, foundation, clamp), at one support about one axis or several, at a "
    "row or all alike, or at any of few about one axis or two, each with a stiffness of its own; in one bar close to a smaller EI "
    "of the whole",
    partial(yielding, turning=True),
    supports,
)
