"""Weight that makes a structure softer against swaying.

K + Kg of the axial forces under weight; K - (g/h) sum M_above b b' for a row of springs.
"""

from mouse_cli.diagnosis.effects.gravity import self_weight
from mouse_cli.diagnosis.mechanisms import Candidate

CANDIDATE = Candidate(
    "gravity",
    "gravity (P-delta)",
    "gravity",
    "the weight above each storey or column pushes it further over as it sways (P-delta): less stiffness, most of it below",
    self_weight,
    lasting=True,
)
