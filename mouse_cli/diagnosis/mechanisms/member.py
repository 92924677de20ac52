"""A member that is softer as a whole: a beam, a row of them, those of a storey, or all of one section.

K - d K_e of all elements of a member, with M - d M_e of its section or without.
"""

from mouse_cli.diagnosis.effects.members import of_members
from mouse_cli.diagnosis.mechanisms import Candidate
from mouse_cli.diagnosis.sites.reasons import members

CANDIDATE = Candidate(
    "member",
    "a softer member",
    "local-stiffness",
    "a beam, a straight row of beams or rods, the columns, braces or beams of one storey, or all members of one section "
    "that are softer as a whole than modelled, all of A, Iy, Iz and J by one factor, alone or with the mass of the section: "
    "a wrong section, corrosion, a member that is missing",
    of_members,
    members,
)
