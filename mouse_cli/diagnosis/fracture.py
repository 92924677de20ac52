"""Compliance of an edge crack of depth a in a bar of height h, plane strain: F1 in bending, F2 in shear, of s = a/h.

F = integral of pi s Y(s)^2 ds, Y the stress intensity factor in units of stress times sqrt(pi a) (Tada, Paris and Irwin,
The Stress Analysis of Cracks Handbook): bending stress 6 M / (b h^2), mean shear stress V / (b h).
"""

from functools import cache

import numpy as np

_X, _W = np.polynomial.legendre.leggauss(24)


def _integral(Y, depth: float) -> float:
    s = depth * (_X + 1) / 2
    return float(depth / 2 * np.sum(_W * np.pi * s * Y(s) ** 2))


def _opening(s: np.ndarray) -> np.ndarray:
    half = np.pi * s / 2
    return np.sqrt(np.tan(half) / half) * (0.923 + 0.199 * (1 - np.sin(half)) ** 4) / np.cos(half)


def _sliding(s: np.ndarray) -> np.ndarray:
    return (1.122 - 0.561 * s + 0.085 * s**2 + 0.180 * s**3) / np.sqrt(1 - s)


@cache
def bending(depth: float) -> float:
    """F1: the angle of the crack under a moment M is 6 (1 - nu^2) h F1 / EI times M."""
    return _integral(_opening, depth)


@cache
def shearing(depth: float) -> float:
    """F2: the sliding of the crack under a force V is (1 - nu^2) h^3 F2 / (6 EI) times V."""
    return _integral(_sliding, depth)
