"""Gyroscopic coupling of two directions of one body: a disc that spins tilts the other way."""

import numpy as np

from mouse_cli.terms.laws import SIGNS, Law, Scale, Unknown


def matrices(p, sign=1.0):
    """C = g [0 1; -1 0], g = Ip Omega of a disc of polar inertia Ip that spins at Omega (G. Genta, Dynamics of Rotating Systems,
    2005, section 3.4), as its two tilts or, condensed on them, its two lateral motions feel it. It does no work.
    """
    zero = np.zeros((2, 2))
    return zero, sign * p[0] * np.array([[0.0, 1.0], [-1.0, 0.0]]), zero


def unknowns(scale: Scale) -> tuple[Unknown, ...]:
    """g by its force beside the elastic one."""
    size = scale.x / scale.v
    return (Unknown("gyroscopic coupling", "N s/m", 1e-4 * scale.softest * size, 3 * scale.stiffness * size),)


LAW = Law(
    "gyroscopic",
    "gyroscopic",
    "gyroscopic coupling",
    "F1 = g v2, F2 = -g v1: a rotor at speed, whose lateral directions move each other and whose modes whirl; positive spin is "
    "from the first degree of freedom towards the second",
    unknowns,
    matrices=matrices,
    variants=SIGNS,
    words=("positive spin", "negative spin"),
    at="plane",
    motions=2,
)
