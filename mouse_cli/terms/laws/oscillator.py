"""A hidden oscillator: a mass that hangs on the structure by a spring and a dashpot."""

import numpy as np

from mouse_cli.terms.laws import Law, Scale, Unknown


def matrices(p):
    """M = diag(0, m), K = m w^2 [1 -1; -1 1], C = 2 zeta m w [1 -1; -1 1]; p: m, f = w / 2 pi, zeta."""
    w, pair = 2 * np.pi * p[1], np.array([[1.0, -1.0], [-1.0, 1.0]])
    return p[0] * w**2 * pair, 2 * p[2] * p[0] * w * pair, np.diag([0.0, p[0]])


def unknowns(scale: Scale) -> tuple[Unknown, ...]:
    """m by its share of the mass there; frequency in the band of the record or near it."""
    low, high = scale.band
    return (
        Unknown("mass", "kg", 1e-3 * scale.mass, 0.5 * scale.heaviest),
        Unknown("frequency", "Hz", 0.7 * low, 1.4 * high),
        Unknown("damping ratio", "1", 1e-3, 0.2),
    )


LAW = Law(
    "oscillator",
    "oscillator",
    "a hidden oscillator",
    "a mass on a spring and a dashpot that the model does not have: one more resonance",
    unknowns,
    matrices=matrices,
    grid=(80, 3),
    at="ground",
)
