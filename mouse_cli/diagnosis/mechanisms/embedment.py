"""A clamp in an elastic wall: K of two springs 2 EI / a^3 across the beam, at its end and at a behind it."""

from mouse_cli.diagnosis.effects.embedded import embedded
from mouse_cli.diagnosis.mechanisms import Candidate
from mouse_cli.diagnosis.sites.reasons import supports

CANDIDATE = Candidate(
    "embedment",
    "a clamp in an elastic wall",
    "support",
    "the end of a beam that is clamped in masonry, soil, a vice or a weld turns and moves, for the beam goes on in it as on an "
    "elastic bed: both by one length, that over which the wall takes the moment",
    embedded,
    supports,
)
