"""A stop on both sides of a clearance."""

import numpy as np

from mouse_cli.terms.laws import Law, Scale, Unknown


def force(x, v, z, p):
    """F = kc (x - g) for x > g, kc (x + g) for x < -g, else 0."""
    return p[0] * (x - np.clip(x, -p[1], p[1])), z


def unknowns(scale: Scale) -> tuple[Unknown, ...]:
    """Stiffness of the stop beside that of the structure; clearance beside the rms motion.

    Two stops softer than 2 % of the structure, which touch before its rms motion, are a hardening spring to any record.
    """
    x, stiff = scale.x, 100 * scale.stiffness
    return Unknown("contact stiffness", "N/m", 0.02 * scale.softest, stiff), Unknown("clearance", "m", 0.05 * x, 4 * x)


LAW = Law(
    "gap",
    "clearance",
    "a clearance with stops on both sides",
    "F = kc (|x| - g) sgn x beyond the clearance g: linear below, stiffer above; odd harmonics, impacts",
    unknowns,
    force,
    grid=24,
)
