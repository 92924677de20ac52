"""A linear dashpot."""

import numpy as np

from mouse_cli.terms.laws import Law, Scale, Unknown


def matrices(p):
    """C = c."""
    zero = np.zeros((1, 1))
    return zero, np.full((1, 1), p[0]), zero


def unknowns(scale: Scale) -> tuple[Unknown, ...]:
    """c by its force beside the elastic one."""
    size = scale.x / scale.v
    return (Unknown("viscous damping", "N s/m", 1e-4 * scale.softest * size, scale.stiffness * size),)


LAW = Law("dashpot", "linear-damping", "a linear dashpot", "F = c v", unknowns, matrices=matrices)
