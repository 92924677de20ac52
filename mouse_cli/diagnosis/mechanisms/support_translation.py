"""A translationally flexible support: The support moves: psi = [-K_ff^-1 K_fs; 1] beside the model, with a spring against it."""

from functools import partial

from mouse_cli.diagnosis.effects.supports import yielding
from mouse_cli.diagnosis.mechanisms import Candidate
from mouse_cli.diagnosis.sites.reasons import supports

CANDIDATE = Candidate(
    "support-translation",
    "a translationally flexible support",
    "support",
    "what the model holds rigidly moves along the direction of a reaction (soil, bearing, test stand), at one support along one "
    "axis or several, at a row or all alike, or at any of few along one axis or two, each with a stiffness of its own; of named "
    "supports of matrices, one, a row, any of few or all alike, in all directions with one stiffness, across their plane and in it "
    "with two (rubber), or in one of both (sliding); and a few nodes of one, side by side: bolts that are loose",
    partial(yielding, turning=False),
    supports,
)
