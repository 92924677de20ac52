"""Microslip of a bolted joint: the four-parameter Iwan model (Segalman, J. Appl. Mech. 72, 2005)."""

import numpy as np

from mouse_cli.terms.laws import Law, Scale, Unknown

SLIDERS = 12  # of the discrete distribution, the last one for the slip of the whole joint
_RATIO = 1.5  # of the slip lengths of neighbours


def force(x, v, z, p):
    """F = sum of k_m (x - z_m), |x - z_m| <= phi_m: density R phi^chi up to phi_max, and beta of the rest at phi_max.

    p: slip force F_S, stiffness before slip K_T, 1 + chi in (0, 1], beta; or their `sliders`.
    """
    lengths, stiffness = p if isinstance(p, tuple) else sliders(p)
    stretch = np.minimum(np.maximum(x - z, -lengths), lengths)
    return (stiffness * stretch).sum(axis=0), x - stretch


def sliders(p) -> tuple[np.ndarray, np.ndarray]:
    """Slip lengths and stiffnesses (SLIDERS, ...): each bin of the density as one slider that has its slip force."""
    F, K, power, beta = p
    both = beta + power / (power + 1)
    longest = F * (1 + beta) / (K * both)
    R, S = F * power / (longest ** (power + 1) * both), F / longest * beta / both
    steps = np.arange(SLIDERS - 1, -1, -1).reshape(-1, *np.ones(np.ndim(F), int))
    edges = longest * _RATIO**-steps
    low, high = np.concatenate([np.zeros_like(edges[:1]), edges[:-1]]), edges
    stiffness = R * (high**power - low**power) / power
    slip = R * (high ** (power + 1) - low ** (power + 1)) / (power + 1)
    lengths = slip / stiffness
    return np.concatenate([lengths, longest[None]]), np.concatenate([stiffness, S[None]])


def unknowns(scale: Scale) -> tuple[Unknown, ...]:
    """Slip force and stiffness beside those of the structure; the exponent of energy dissipation is 2 + 1 + chi."""
    k, (low, high) = scale.stiffness, scale.forces
    return (
        Unknown("slip force", "N", 0.01 * low, 10 * high),
        Unknown("stiffness before slip", "N/m", 0.02 * scale.softest, 100 * k),
        Unknown("1 + chi", "1", 0.1, 1.0),
        Unknown("beta", "1", 0.01, 10.0),
    )


LAW = Law(
    "iwan",
    "friction",
    "microslip of a joint (Iwan)",
    "many Jenkins elements with slip forces spread by a power law: frequency falls and damping rises gradually with the amplitude",
    unknowns,
    force,
    homogeneous=(0, 1),
    grid=4,
    states=SLIDERS + 1,
    prepare=sliders,
)
