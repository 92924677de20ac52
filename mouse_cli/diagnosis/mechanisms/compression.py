"""Compression of a straight row of bars: K - T times the integral of w' w'."""

from functools import partial

from mouse_cli.diagnosis.mechanisms import Candidate
from mouse_cli.diagnosis.sites.preload import preloads
from mouse_cli.diagnosis.sites.reasons import bars

CANDIDATE = Candidate(
    "compression",
    "axial compression",
    "axial",
    "a push along a row of bars, or along rows side by side alike (thermal, dead load, prestress), that softens their bending: low "
    "modes fall most; it stays below buckling",
    partial(preloads, sign=-1),
    bars,
)
