"""Coulomb friction behind a spring (Jenkins element)."""

import numpy as np

from mouse_cli.terms.laws import Law, Scale, Unknown


def force(x, v, z, p):
    """F = kt (x - z), |F| <= Fs: the slider z is dragged along when the limit is reached."""
    limit = p[1] / p[0]
    stretch = np.minimum(np.maximum(x - z[0], -limit), limit)  # at each step of each simulation: np.clip takes twice as long
    return p[0] * stretch, (x - stretch)[None]


def unknowns(scale: Scale) -> tuple[Unknown, ...]:
    """Stiffness before slip beside that of the structure; slip force beside those of the rms motion."""
    k, (low, high) = scale.stiffness, scale.forces
    stiff = float(np.clip(scale.stiffest, 100 * k, 1e4 * k))  # Coulomb's law, as far as a simulation can follow it
    return (
        Unknown("stiffness before slip", "N/m", 0.02 * scale.softest, stiff),
        Unknown("slip force", "N", 0.003 * low, 3 * high),
    )


LAW = Law(
    "friction",
    "friction",
    "friction (slip behind a spring)",
    "F = kt (x - z), |F| <= Fs (Jenkins; Coulomb for stiff kt): damping falls with the amplitude, the frequency drops at slip",
    unknowns,
    force,
    homogeneous=(0, 1),
    grid=24,
    states=1,
    limit=(1, "linear-stiffness"),  # what never slips is a spring
    amounts=(("spring", 1, "yielding"),),  # where one of the model is lost
)
