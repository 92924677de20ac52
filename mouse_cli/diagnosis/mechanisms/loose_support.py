"""A support that has come loose: it gives along an axis and turns. The support moves: psi = [-K_ff^-1 K_fs; 1], on springs."""

from mouse_cli.diagnosis.effects.supports import loose
from mouse_cli.diagnosis.mechanisms import Candidate
from mouse_cli.diagnosis.sites.reasons import supports

CANDIDATE = Candidate(
    "loose-support",
    "a loose support",
    "support",
    "the support of one node, or of all alike, that gives along one axis, or along all, and turns: anchors or bolts that are "
    "loose, a foot that lifts, feet on soil; each direction with a stiffness of its own",
    loose,
    supports,
)
