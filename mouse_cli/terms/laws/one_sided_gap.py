"""A stop on one side of a clearance."""

import numpy as np

from mouse_cli.terms.laws import SIGNS, Law, Scale, Unknown


def force(x, v, z, p, sign=1.0):
    """F = kc (x - g) for x > g, else 0; mirrored for the other side."""
    return sign * p[0] * np.maximum(sign * x - p[1], 0.0), z


def unknowns(scale: Scale) -> tuple[Unknown, ...]:
    """Stiffness of the stop beside that of the structure; clearance beside the rms motion: with none at all it is `bilinear`."""
    x, stiff = scale.x, 100 * scale.stiffness
    return Unknown("contact stiffness", "N/m", 0.002 * scale.softest, stiff), Unknown("clearance", "m", 0.2 * x, 4 * x)


LAW = Law(
    "one-sided-gap",
    "clearance",
    "a clearance with a stop on one side",
    "F = kc (x - g) beyond the clearance g on one side: even and odd harmonics, impacts",
    unknowns,
    force,
    variants=SIGNS,
    words=("positive side", "negative side"),
    grid=24,
    odd=False,
)
