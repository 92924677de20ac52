"""H2: least squares over the force."""

import numpy as np

from mouse_cli.records.blocks import Products
from mouse_cli.records.frf_estimators import FrfEstimator


def _estimate(products: Products) -> np.ndarray:
    """H2 = Gyy / Gxy of one force; noise of the response makes it too large by Gnn / Gyy."""
    with np.errstate(divide="ignore", invalid="ignore"):
        return products.Gyy[:, :, None] / products.Gyx.conj()


def _relative(coherence: np.ndarray) -> np.ndarray:
    """That of 1 / H2, which is least squares with the channels exchanged."""
    return (1 - coherence) / coherence


FRF_ESTIMATOR = FrfEstimator("h2", _estimate, _relative, "noise on the force", single=True)
