"""Shear flexibility of bars, after Timoshenko, without the inertia of sections that turn.

phi = 12 EI / (kappa G A l^2) of every bar, from E / (kappa G).
"""

from functools import partial

from mouse_cli.diagnosis.effects.shearing import sheared
from mouse_cli.diagnosis.mechanisms import Candidate
from mouse_cli.diagnosis.sites.reasons import bars

CANDIDATE = Candidate(
    "shear",
    "shear flexibility",
    "shear",
    "shear flexibility of bars (Timoshenko): frequencies of high modes fall with the square of their wave number, low ones stay",
    partial(sheared, turning=False),
    bars,
    lasting=True,
)
