"""Minimum dynamic residual expansion: the residual force measured by the energy it would put into the structure."""

import numpy as np

from mouse_cli.dynamics.expansion import Expansion, Measured
from mouse_cli.dynamics.expansion.residual import least_residual


def expand(measured: Measured) -> np.ndarray:
    """Shapes (n, m) that minimise r'K^-1 r, r = (K - lambda_i M) u (Balmes 2000, MDRE); the same in every unit."""
    return least_residual(measured, "energy")


EXPANSION = Expansion(
    "residual-energy", "minimum dynamic residual (MDRE)", "minimise r'K^-1 r, r = (K - lambda M) u, with S u = t, or near it",
    "optional", expand,
)  # fmt: skip
