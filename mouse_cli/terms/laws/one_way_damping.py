"""Another damping in one direction."""

import numpy as np

from mouse_cli.terms.laws import SIGNS, Law, Scale, Unknown


def force(x, v, z, p, sign=1.0):
    """F = dc v for v > 0, else 0."""
    return sign * p[0] * np.maximum(v, 0.0), z


def unknowns(scale: Scale) -> tuple[Unknown, ...]:
    """dc by its force beside the elastic one, both at rms motion."""
    size = scale.x / scale.v
    least, most = 1e-3 * scale.softest * size, 3 * scale.stiffness * size
    return (Unknown("damping of one direction less the other's", "N s/m", least, most),)


LAW = Law(
    "one-way-damping",
    "one-way-damping",
    "a damping that is another one in one direction",
    "F = dc v for v > 0 (dampers with valves: compression and rebound): even harmonics, the mean moves with the amplitude",
    unknowns,
    force,
    variants=SIGNS,
    words=("more damped for positive velocity", "less damped for positive velocity"),
    odd=False,
)
