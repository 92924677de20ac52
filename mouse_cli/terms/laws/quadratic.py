"""Quadratic stiffness, odd."""

import numpy as np

from mouse_cli.terms.laws import SIGNS, Law, Scale, Unknown


def force(x, v, z, p, sign=1.0):
    """F = k2 x |x|."""
    return sign * p[0] * x * np.abs(x), z


def unknowns(scale: Scale) -> tuple[Unknown, ...]:
    """k2 by its share of the linear stiffness at the rms motion."""
    return (Unknown("quadratic stiffness", "N/m^2", 1e-4 * scale.softest / scale.x, 3 * scale.stiffness / scale.x),)


LAW = Law(
    "quadratic",
    "smooth-stiffness",
    "quadratic stiffness",
    "F = k2 x |x|: the frequency rises (or falls) with the amplitude; odd harmonics",
    unknowns,
    force,
    variants=SIGNS,
    words=("hardening", "softening"),
)
