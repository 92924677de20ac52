"""A contact or a cable that is under load at rest, and opens or goes slack."""

import numpy as np

from mouse_cli.terms.laws import Law, Scale, Unknown


def force(x, v, z, p, sign=1.0, lost=0.0):
    """F = k x as long as it is under load, x > -g, and -k g beyond, its preload; mirrored for the other side. x is from rest, where
    the preload is balanced.

    lost: 1 of a spring k that the model has for good, of which F takes k x off.
    """
    return p[0] * (sign * np.maximum(sign * x, -p[1]) - lost * x), z


def unknowns(scale: Scale) -> tuple[Unknown, ...]:
    """Stiffness beside that of the structure; opening beside the rms motion: with none it is `bilinear`, never reached a spring."""
    k, x = scale.stiffness, scale.x
    return Unknown("contact stiffness", "N/m", 0.02 * scale.softest, 10 * k), Unknown("opening", "m", 0.02 * x, 2.5 * x)


LAW = Law(
    "preload",
    "bilinear",
    "a preloaded contact that opens",
    "F = k x under load, no more than its preload k g beyond (cables that go slack, joints and bearings that gape): linear for "
    "small motion, then softer on one side",
    unknowns,
    force,
    variants=(*({"sign": sign} for sign in (1.0, -1.0)), *({"sign": sign, "lost": 1.0} for sign in (1.0, -1.0))),
    words=(
        "opens for negative motion",
        "opens for positive motion",
        "the model's opens for negative motion",
        "the model's opens for positive motion",
    ),
    grid=24,
    odd=False,
    linked=(2, 3),
)
