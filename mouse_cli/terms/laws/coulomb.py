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
    R = (free - v) / (2 * drop) + before / 2
    slides = free - drop * p[0] * np.sign(v)
    on = np.sign(v) * slides > 0
    rest = np.where(v == 0, 1.0, 1 - v / np.where(v == slides, np.inf, v - slides))
    there = np.where(np.abs(R) <= p[0], 0.0, (R - p[0] * np.sign(R)) * 2 * drop * rest)
    end = np.where(on, p[0] * np.sign(v), np.clip(R, -p[0], p[0]))
    return (free - np.where(on, slides, there)) / drop, end


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
