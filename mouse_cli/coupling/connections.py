"""Connections with one degree of freedom: their dynamic stiffness z(s), the force for a unit of motion (lecture 22, simplified
expressions).

    mass                 z = s^2 m
    spring, dashpot      z = k (1 + i eta) + s c
    absorber             z = s^2 m (k (1 + i eta) + s c) / (s^2 m + k (1 + i eta) + s c)

At one place of receptance alpha the modified receptance is alpha_C = alpha - alpha (alpha + 1/z)^-1 alpha = alpha / (1 + z alpha).
"""

from dataclasses import replace

import numpy as np

from mouse_cli.model.coupling import Connection


def dynamic_stiffness(one: Connection, s: np.ndarray) -> np.ndarray:
    """z (f,) at s (f,), N/m."""
    spring = one.stiffness * (1 + 1j * one.loss_factor) + s * one.damping
    inertia = s**2 * one.mass
    if not one.hung:
        return inertia + spring
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.where(inertia + spring == 0, np.inf, inertia * spring / (inertia + spring))


def tuned(one: Connection, hz: float, modal_mass: float) -> Connection:
    """An absorber tuned to a mode of frequency hz, whose mass as its place moves is `modal_mass` = 1/phi^2 for X'MX = 1.

    f_a = f / (1 + mu), zeta_a = sqrt(3 mu / (8 (1 + mu))), mu = m / modal mass (Den Hartog, Mechanical Vibrations, 4th ed.
    1956, sec. 3.3; his c / c_c is that of the mode's frequency, zeta_a / (1 + mu)).

    >>> from mouse_cli.model.coupling import Connection, Point
    >>> a = tuned(Connection("a", Point(0, 0), mass=0.25, hung=True, tuned_to=1), 10.0, 1.0)
    >>> round(float((a.stiffness / a.mass) ** 0.5 / (2 * 3.141592653589793)), 9)
    8.0
    """
    mu = one.mass / modal_mass
    omega = 2 * np.pi * hz / (1 + mu)
    ratio = np.sqrt(3 * mu / (8 * (1 + mu))) if one.ratio is None else one.ratio
    return replace(one, stiffness=one.mass * omega**2, damping=2 * ratio * one.mass * omega, tuned_to=None)
