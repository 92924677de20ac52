"""A linear spring."""

import numpy as np

from mouse_cli.terms.laws import SIGNS, Law, Scale, Unknown


def matrices(p, sign=1.0):
    """K = dk."""
    zero = np.zeros((1, 1))
    return np.full((1, 1), sign * p[0]), zero, zero


def unknowns(scale: Scale) -> tuple[Unknown, ...]:
    """dk by its share of the stiffness."""
    return (Unknown("stiffness", "N/m", 1e-3 * scale.softest, 2 * scale.stiffness),)


LAW = Law(
    "spring",
    "linear-stiffness",
    "a linear spring",
    "F = k x, or a loss of stiffness",
    unknowns,
    matrices=matrices,
    variants=SIGNS,
    words=("added", "lost"),
    linked=(1,),
)
