"""A Maxwell element: a spring and a dashpot in series."""

import numpy as np

from mouse_cli.terms.laws import Law, Scale, Unknown

_LIGHT = 1e-6  # mass of the point between spring and dashpot, by c^2 / k: it settles a million times faster than the element


def matrices(p):
    """F = k (x - q), c q' = k (x - q), c = k tau: stiff above 1 / (2 pi tau), a dashpot below; p: k, tau.

    The elongation q of the dashpot is a coordinate with next to no mass, so that models with it are stepped as others are (R. M.
    Christensen, Theory of Viscoelasticity, 1982, section 1.4).
    """
    k, c = p[0], p[0] * p[1]
    return k * np.array([[1.0, -1.0], [-1.0, 1.0]]), np.diag([0.0, c]), np.diag([0.0, _LIGHT * c * p[1]])


def unknowns(scale: Scale) -> tuple[Unknown, ...]:
    """k by its share of the stiffness; the time by the band of the record, beyond which it is a dashpot or a spring."""
    low, high = scale.band
    return (
        Unknown("stiffness in series", "N/m", 1e-3 * scale.softest, 2 * scale.stiffness),
        Unknown("relaxation time", "s", 0.1 / (2 * np.pi * high), 10 / (2 * np.pi * low)),
    )


LAW = Law(
    "maxwell",
    "viscoelastic",
    "a spring and a dashpot in series (Maxwell)",
    "F = k (x - q), k tau q' = F: a damper behind a flexible brace or mount, oil, rubber: stiffer and less damped at high "
    "frequency",
    unknowns,
    matrices=matrices,
    massless=True,
)
