"""Another stiffness on one side (a breathing crack)."""

import numpy as np

from mouse_cli.terms.laws import SIGNS, Law, Scale, Unknown


def force(x, v, z, p, sign=1.0):
    """F = dk x for x > 0, else 0."""
    return sign * p[0] * np.maximum(x, 0.0), z


def unknowns(scale: Scale) -> tuple[Unknown, ...]:
    """dk by its share of the linear stiffness."""
    return (Unknown("stiffness of one side less the other's", "N/m", 0.002 * scale.softest, 2 * scale.stiffness),)


LAW = Law(
    "bilinear",
    "bilinear",
    "a stiffness that is another one on one side",
    "F = dk x for x > 0 (breathing crack): frequencies independent of the amplitude, even harmonics, an offset",
    unknowns,
    force,
    variants=SIGNS,
    words=("stiffer for positive motion", "softer for positive motion"),
    odd=False,
)
