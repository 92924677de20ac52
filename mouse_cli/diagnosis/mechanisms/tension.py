"""Tension of a straight row of bars: K + T times the integral of w' w'."""

from functools import partial

from mouse_cli.diagnosis.mechanisms import Candidate
from mouse_cli.diagnosis.sites.preload import preloads
from mouse_cli.diagnosis.sites.reasons import bars

CANDIDATE = Candidate(
    "tension",
    "axial tension",
    "axial",
    "a pull along a row of bars, or along rows side by side alike (thermal, cable, prestress), that stiffens their bending: low "
    "modes rise most, high ones hardly",
    partial(preloads, sign=1),
    bars,
)
