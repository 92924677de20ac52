"""A foundation that rocks or slides as one body."""

from mouse_cli.diagnosis.effects.rocking import rocking
from mouse_cli.diagnosis.mechanisms import Candidate
from mouse_cli.diagnosis.sites.reasons import bases

CANDIDATE = Candidate(
    "rocking",
    "a foundation that moves as one body",
    "support",
    "all supports together (a raft, a footing, a flange, a test bed) move as one rigid body against springs, along or about an "
    "axis; storeys over one base, or springs between floors, in a model without rotations, turn with it, by heights from the "
    "coordinates",
    rocking,
    bases,
)
