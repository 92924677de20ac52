"""A lumped mass, which its body carries along wherever it moves."""

import numpy as np

from mouse_cli.terms.laws import Law, Scale, Unknown


def matrices(p):
    """M = m."""
    zero = np.zeros((1, 1))
    return zero, zero, np.full((1, 1), p[0])


def unknowns(scale: Scale) -> tuple[Unknown, ...]:
    """m by its share of the mass there."""
    return (Unknown("mass", "kg", 1e-3 * scale.mass, 2 * scale.heaviest),)


LAW = Law("mass", "mass", "a lumped mass", "F = m a", unknowns, matrices=matrices, at="body")
