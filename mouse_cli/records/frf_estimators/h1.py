"""H1: least squares over the responses."""

import numpy as np

from mouse_cli.records.blocks import Products
from mouse_cli.records.frf_estimators import FrfEstimator, inverse


def _estimate(products: Products) -> np.ndarray:
    """H1 = Gyx Gxx^-1, one inversion a line; noise of the forces makes it too small by Gmm / Gxx."""
    return products.Gyx @ inverse(products.Gxx)


def _relative(coherence: np.ndarray) -> np.ndarray:
    return (1 - coherence) / coherence


FRF_ESTIMATOR = FrfEstimator("h1", _estimate, _relative, "noise on the responses")
