"""Damping by a power of the velocity."""

import numpy as np

from mouse_cli.terms.laws import Law, Scale, Unknown

_LEAST, _MOST = 1.2, 5.0  # exponent: below, it is nearly a dashpot, or friction


def force(x, v, z, p):
    """F = F1 |v|^n sgn v, v in m/s."""
    return p[0] * np.sign(v) * np.abs(v) ** p[1], z


def unknowns(scale: Scale) -> tuple[Unknown, ...]:
    """F1 by its force beside the elastic one, both at rms motion, at any exponent."""
    powers, x = (scale.v**_LEAST, scale.v**_MOST), scale.x
    return (
        Unknown("force at unit velocity", "N", 1e-4 * scale.softest * x / max(powers), scale.stiffness * x / min(powers)),
        Unknown("exponent", "1", _LEAST, _MOST),
    )


LAW = Law(
    "power-damping",
    "quadratic-damping",
    "damping by a power of the velocity",
    "F = F1 |v|^n sgn v (oil and air in narrow gaps, dampers of buildings): as by the square, with another exponent",
    unknowns,
    force,
)
