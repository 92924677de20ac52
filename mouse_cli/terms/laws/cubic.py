"""Cubic stiffness (Duffing)."""

from mouse_cli.terms.laws import SIGNS, Law, Scale, Unknown


def force(x, v, z, p, sign=1.0):
    """F = k3 x^3."""
    return sign * p[0] * x * x * x, z


def unknowns(scale: Scale) -> tuple[Unknown, ...]:
    """k3 by its share of the linear stiffness at the rms motion."""
    x = scale.x
    return (Unknown("cubic stiffness", "N/m^3", 1e-4 * scale.softest / x**2, 3 * scale.stiffness / x**2),)


LAW = Law(
    "cubic",
    "smooth-stiffness",
    "cubic stiffness",
    "F = k3 x^3: the frequency rises (or falls) with the square of the amplitude; odd harmonics",
    unknowns,
    force,
    variants=SIGNS,
    words=("hardening", "softening"),
)
