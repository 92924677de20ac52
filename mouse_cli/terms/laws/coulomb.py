"""Dry friction (Coulomb): sticks at once, without a spring before slip."""

import numpy as np

from mouse_cli.terms.laws import Law, Scale, Unknown


def force(x, v, z, p):
    """F = Fs sgn v."""
    return p[0] * np.sign(v), z


def implicit(v, before, free, drop, p):
    """F over a step that begins with velocity v and force `before`, and F at its end; see `dynamics.response.Implicit`.

    free - drop F is the velocity at the end. Where it passes zero on the way the mass stops, and sticks if the mean R of all other
    forces of the step is no more than Fs (velocity 0, F = R at the end), or else goes on the other way for the rest of the step.
    """
    sign = np.sign(v)
    slip = p[0] * sign
    slides = free - drop * slip
    on = sign * slides > 0
    if on.all():
        return slip, slip
    R = (free - v) / (2 * drop) + before / 2
    held = np.minimum(np.maximum(R, -p[0]), p[0])
    rest = 1 - v / np.where(v == slides, np.inf, v - slides)  # share of the step behind the stop: all of it from rest
    there = (R - held) * 2 * drop * rest
    return np.where(on, slip, (free - there) / drop), np.where(on, slip, held)


def unknowns(scale: Scale) -> tuple[Unknown, ...]:
    """Slip force beside those of the rms motion."""
    low, high = scale.forces
    return (Unknown("slip force", "N", 0.003 * low, 3 * high),)


LAW = Law(
    "coulomb",
    "friction",
    "dry friction (Coulomb)",
    "F = Fs sgn v, |F| <= Fs at rest: sliding guides and drives; motion stops and sticks, damping falls with the amplitude",
    unknowns,
    force,
    implicit=implicit,
)
