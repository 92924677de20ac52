"""Play in a link that the model has without it."""

import numpy as np

from mouse_cli.terms.laws import Law, Scale, Unknown


def force(x, v, z, p):
    """F = -k x for |x| < g, -k g sgn x beyond: with the spring k of the model k (x -+ g) is left where the play is closed."""
    return -p[0] * np.clip(x, -p[1], p[1]), z


def unknowns(scale: Scale) -> tuple[Unknown, ...]:
    """Stiffness that the play takes beside that of the link; clearance beside the rms motion."""
    return (
        Unknown("stiffness without contact", "N/m", 0.3 * scale.link, 1.2 * scale.link),
        Unknown("clearance", "m", 0.01 * scale.x, 4 * scale.x),
    )


LAW = Law(
    "play",
    "play",
    "play in a link",
    "a spring of the model carries nothing within a clearance: softer at small motion, where a stop is stiffer at large motion",
    unknowns,
    force,
    homogeneous=(0,),
    grid=24,
    at="link",
)
