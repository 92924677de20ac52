"""A spring of the model of which a part yields, or slips, at a force."""

import numpy as np

from mouse_cli.terms.laws import Law, Scale, Unknown


def force(x, v, z, p):
    """F = -ky z, z what the part has yielded: with the spring k of the model k x at first, and (k - ky) x + Fy sgn x beyond.

    Bilinear hysteresis with kinematic hardening (A. K. Chopra, Dynamics of Structures, 2017, section 7.2).
    """
    limit = p[1] / p[0]
    yielded = x - np.minimum(np.maximum(x - z[0], -limit), limit)
    return -p[0] * yielded, yielded[None]


def unknowns(scale: Scale) -> tuple[Unknown, ...]:
    """Stiffness of the part beside that of the link; its force beside that of the rms motion."""
    elastic = scale.link * scale.x
    return (
        Unknown("stiffness that yields", "N/m", 0.05 * scale.link, 1.2 * scale.link),
        Unknown("yield force", "N", 0.003 * elastic, 3 * elastic),
    )


LAW = Law(
    "yielding",
    "friction",
    "a spring that yields",
    "part of a spring of the model slips or yields at a force: as stiff as modelled at small motion, where friction adds stiffness",
    unknowns,
    force,
    homogeneous=(0, 1),
    grid=24,
    states=1,
    at="link",
    limit=(1, "linear-stiffness"),  # what yields at once is a spring that is lost
    amounts=(("spring", 0, "friction"),),  # with one added
)
