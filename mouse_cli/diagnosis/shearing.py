"""Matrices of bars after Timoshenko, as changes of those after Euler and Bernoulli."""

import numpy as np

from mouse_cli.diagnosis.bars import Bars
from mouse_cli.terms.elements import _beam as beam


def shear_range(bars: Bars) -> tuple[float, float]:
    """E / (kappa G) for which EI / (kappa G A L^2) is between 1e-5 and 3e-2, L the longest line."""
    radius = float(np.average(bars.EI / bars.E / bars.A, weights=bars.length))
    return 1e-5 * bars.span**2 / radius, 3e-2 * bars.span**2 / radius


def shear(bars: Bars, ratio: float, rotary: bool) -> tuple[np.ndarray, np.ndarray]:
    """Changes of K and M (r, r) for E / (kappa G) = `ratio`: F_aa = l / (3 EI) (1 + phi), and shapes with phi in the mass."""
    phi = 12 * (bars.EI / bars.E) / bars.A * ratio / bars.length**2
    added = np.zeros((len(bars), 2, 2))
    added[:, 1, 1] = bars.length / (3 * bars.EI) * (phi - bars.phi)
    K = bars.softened(np.arange(len(bars)), added)
    blocks = _mass(bars, phi, rotary) - _mass(bars, bars.phi, False)
    return K, bars.added(blocks)


def rotary(bars: Bars) -> np.ndarray:
    """Mass (r, r) of sections that turn."""
    _, _, rotation = beam.shapes(bars.length, bars.phi)
    return bars.added(beam.integral(rotation, bars.section_inertia * bars.length))


def _mass(bars: Bars, phi: np.ndarray, rotary: bool) -> np.ndarray:
    w, _, rotation = beam.shapes(bars.length, phi)
    blocks = beam.integral(w, bars.line_mass * bars.length)
    return blocks + beam.integral(rotation, bars.section_inertia * bars.length) if rotary else blocks
