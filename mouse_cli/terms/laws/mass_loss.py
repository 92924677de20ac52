"""A lumped mass of the model that is lighter, or gone."""

import numpy as np

from mouse_cli.terms.laws import Law, Scale, Unknown

_ALL = 0.98  # share of the mass there, with which it has almost no inertia any more


def matrices(p):
    """M = -m."""
    zero = np.zeros((1, 1))
    return zero, zero, np.full((1, 1), -p[0])


def unknowns(scale: Scale) -> tuple[Unknown, ...]:
    """m by its share of the mass there, of which there is no more to lose."""
    return (Unknown("mass", "kg", 1e-3 * scale.mass, _ALL * scale.mass),)


LAW = Law(
    "mass-loss",
    "mass-loss",
    "a lumped mass that is lighter than in the model",
    "F = -m a: a mass of the model that has lost a part of itself, or is gone",
    unknowns,
    matrices=matrices,
    at="body",
)
