"""Static expansion: the shape that the stiffness alone gives between the sensors."""

import numpy as np

from mouse_cli.dynamics.condensation import held
from mouse_cli.dynamics.expansion import Expansion, Measured


def expand(measured: Measured) -> np.ndarray:
    """Shapes (n, m) of least strain energy through the measured components, u_o = -K_oo^-1 K_oa u_a (Guyan 1965)."""
    return np.column_stack([held(measured.K, sensing, t[:, None]) for sensing, t, _ in measured.modes()])


EXPANSION = Expansion(
    "guyan", "static expansion (Guyan)", "minimise u'K u with S u = t: inertia between the sensors is left out", "never", expand
)  # fmt: skip
