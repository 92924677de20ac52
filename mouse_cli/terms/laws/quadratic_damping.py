"""Damping by the square of the velocity."""

import numpy as np

from mouse_cli.terms.laws import Law, Scale, Unknown


def force(x, v, z, p):
    """F = c2 v |v|."""
    return p[0] * v * np.abs(v), z


def unknowns(scale: Scale) -> tuple[Unknown, ...]:
    """c2 by its force beside the elastic one, both at rms motion."""
    size = scale.x / scale.v**2
    return (Unknown("quadratic damping", "N s^2/m^2", 1e-4 * scale.softest * size, scale.stiffness * size),)


LAW = Law(
    "quadratic-damping",
    "quadratic-damping",
    "damping by the square of the velocity",
    "F = c2 v |v| (drag, orifices): damping rises with the amplitude, the frequency stays",
    unknowns,
    force,
)
