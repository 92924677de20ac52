"""Compliance of an edge crack of depth a in a bar of height h, plane strain, of s = a/h: in bending, shear and tension.

F1 is that in bending, F2 in shear, F3 in tension, and F12 of bending and tension together.

F = integral of pi s Y(s)^2 ds, or of the product of two, Y the stress intensity factor in units of stress times sqrt(pi a) (Tada,
Paris and Irwin, The Stress Analysis of Cracks Handbook): bending stress 6 M / (b h^2), mean stress N / (b h), mean shear stress
V / (b h). Depths (...,) may be complex, for derivatives by a complex step.
"""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

_X, _W = np.polynomial.legendre.leggauss(24)
_Factor = Callable[[np.ndarray], np.ndarray]


def _integral(one: _Factor, other: _Factor, depth: np.ndarray) -> np.ndarray:
    depth = np.asarray(depth)[..., None]
    s = depth * (_X + 1) / 2
    return (depth / 2 * np.pi * s * one(s) * other(s)) @ _W


def _opening(s: np.ndarray) -> np.ndarray:
    half = np.pi * s / 2
    return np.sqrt(np.tan(half) / half) * (0.923 + 0.199 * (1 - np.sin(half)) ** 4) / np.cos(half)


def _stretching(s: np.ndarray) -> np.ndarray:
    half = np.pi * s / 2
    return np.sqrt(np.tan(half) / half) * (0.752 + 2.02 * s + 0.37 * (1 - np.sin(half)) ** 3) / np.cos(half)


def _sliding(s: np.ndarray) -> np.ndarray:
    return (1.122 - 0.561 * s + 0.085 * s**2 + 0.180 * s**3) / np.sqrt(1 - s)


class Compliance(NamedTuple):
    """What a crack adds: its angle for a moment, sliding for a force across and parting for one along the bar, at the axis.

    both: parting for a moment, and angle for a force along the bar: open on one side, the crack turns about a point off the axis.
    """

    turning: np.ndarray
    sliding: np.ndarray
    parting: np.ndarray
    both: np.ndarray


def factors(depth: np.ndarray) -> Compliance:
    """F1, F2, F3 and F12 in the places of what they make."""
    pairs = (_opening, _opening), (_sliding, _sliding), (_stretching, _stretching), (_opening, _stretching)
    return Compliance(*(_integral(*pair, depth) for pair in pairs))


def compliance(of: Compliance, height: np.ndarray, EI: np.ndarray, nu: np.ndarray) -> Compliance:
    """6 c F1, c h^2 F2 / 6, c h^2 F3 / 6 and c h F12 with c = (1 - nu^2) h / EI, for the `factors` of a depth."""
    c = (1 - nu**2) * height / EI
    return Compliance(
        6 * c * of.turning, c * height**2 * of.sliding / 6, c * height**2 * of.parting / 6, c * height * of.both
    )
