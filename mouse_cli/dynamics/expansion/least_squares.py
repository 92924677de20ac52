"""Expansion by constrained least squares: the smallest force that the model needs to vibrate as measured."""

import numpy as np

from mouse_cli.dynamics.expansion import Expansion, Measured
from mouse_cli.dynamics.expansion.residual import least_residual


def expand(measured: Measured) -> np.ndarray:
    """Shapes (n, m) that minimise |(K - lambda_i M) u| (Ahmadian, lecture 21-1; Friswell and Mottershead 1995, sec. 4.4).

    Forces and moments count alike, so the answer depends on the unit of length; `residual-energy` does not.
    """
    return least_residual(measured, "euclidean")


EXPANSION = Expansion(
    "least-squares",
    "constrained least squares",
    "minimise |(K - lambda M) u| with S u = t, or near it",
    "optional",
    expand,
)
