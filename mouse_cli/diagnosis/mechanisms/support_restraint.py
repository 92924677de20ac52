"""A support that resists turning, where the model lets it turn."""

from mouse_cli.diagnosis.effects.restraints import resisting
from mouse_cli.diagnosis.mechanisms import Candidate
from mouse_cli.diagnosis.sites.reasons import turning

CANDIDATE = Candidate(
    "support-restraint",
    "a support that resists turning",
    "ground-spring",
    "what the model pins is partly clamped: a base plate with anchors, a bearing that has seized, a spherical joint that is stiff; "
    "K + k b'b for a rotation b of a node that is held but free to turn, one alone, both of a node, or a row or all of them alike",
    resisting,
    turning,
)
