"""Compliance of an edge crack of depth a in a bar of height h, plane strain, of s = a/h: F1 in bending, F2 in shear, F3 in tension.

F = integral of pi s Y(s)^2 ds, or of the product of two, Y the stress intensity factor in units of stress times sqrt(pi a) (Tada,
Paris and Irwin, The Stress Analysis of Cracks Handbook): bending stress 6 M / (b h^2), mean stress N / (b h), mean shear stress
V / (b h). Depths (...,) may be complex, for derivatives by a complex step.
"""

from collections.abc import Callable

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


def bending(depth: np.ndarray) -> np.ndarray:
    """F1: the angle of the crack under a moment M is 6 (1 - nu^2) h F1 / EI times M."""
    return _integral(_opening, _opening, depth)


def coupling(depth: np.ndarray) -> np.ndarray:
    """F12: under a moment M the two sides part at the axis by (1 - nu^2) h^2 F12 / EI times M, being open on one side."""
    return _integral(_opening, _stretching, depth)


def stretching(depth: np.ndarray) -> np.ndarray:
    """F3: they part by (1 - nu^2) h^3 F3 / (6 EI) times N under a tension N."""
    return _integral(_stretching, _stretching, depth)


def shearing(depth: np.ndarray) -> np.ndarray:
    """F2: the sliding of the crack under a force V is (1 - nu^2) h^3 F2 / (6 EI) times V."""
    return _integral(_sliding, _sliding, depth)
