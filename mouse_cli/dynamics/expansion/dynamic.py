"""Dynamic expansion: no force but at the sensors, at the measured frequency of each mode."""

import numpy as np

from mouse_cli.dynamics.condensation import held
from mouse_cli.dynamics.expansion import Expansion, Measured


def expand(measured: Measured) -> np.ndarray:
    """Shapes (n, m) with u_o = -Z_oo^-1 Z_oa u_a, Z = K - lambda_i M (Kidder 1973); one factorisation a mode."""
    K, M = measured.K, measured.M
    return np.column_stack(
        [
            held(K - eigenvalue * M, sensing, t[:, None])
            for eigenvalue, (sensing, t, _) in zip(measured.eigenvalues, measured.modes(), strict=True)
        ]
    )


EXPANSION = Expansion(
    "dynamic", "dynamic expansion", "(K - lambda M) u = S'f with S u = t: exact for the model's own modes", "never", expand
)  # fmt: skip
