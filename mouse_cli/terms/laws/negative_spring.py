"""A negative spring to the ground: a magnet, an electrode, a weight above its support."""

import numpy as np

from mouse_cli.terms.laws import Law, Scale, Unknown


def matrices(p):
    """K = -k."""
    zero = np.zeros((1, 1))
    return np.full((1, 1), -p[0]), zero, zero


def unknowns(scale: Scale) -> tuple[Unknown, ...]:
    """k by its share of the stiffness of the structure, which holds against it."""
    return (Unknown("negative stiffness", "N/m", 1e-3 * scale.softest, scale.stiffness),)


LAW = Law(
    "negative-spring",
    "linear-stiffness",
    "a negative spring to the ground",
    "F = -k x: pulls away from the position of rest, as a magnet, a charged electrode, or a weight above its support does",
    unknowns,
    matrices=matrices,
    at="ground",
    solitary=True,
)
