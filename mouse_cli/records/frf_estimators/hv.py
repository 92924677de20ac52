"""Hv: total least squares over forces and response."""

import numpy as np

from mouse_cli.records.blocks import Products
from mouse_cli.records.frf_estimators import FrfEstimator


def _estimate(products: Products) -> np.ndarray:
    """Of each response, from the vector of least power of all channels (Rocklin, Crowley & Vold, IMAC 1985).

    v = argmin v^H G v / v^H v of G = [[Gxx, Gxy], [Gyx, Gyy]], every channel brought to power 1 at each line, so that the noise is
    in proportion to the signals whatever their units are; H = -(v_x / v_y)^H. For one force this is sqrt(H1 H2) (H1 and H2 have
    one phase).
    """
    f, o, i = products.Gyx.shape
    H = np.full((f, o, i), np.nan, complex)
    for j in range(o):
        G = np.empty((f, i + 1, i + 1), complex)
        G[:, :i, :i], G[:, i, i] = products.Gxx, products.Gyy[:, j]
        G[:, i, :i], G[:, :i, i] = products.Gyx[:, j], products.Gyx[:, j].conj()
        size = np.sqrt(np.einsum("fkk->fk", G).real)
        sound = (size > 0).all(axis=1)
        scaled = G[sound] / (size[sound, :, None] * size[sound, None, :])
        v = np.linalg.eigh(scaled)[1][:, :, 0]
        with np.errstate(divide="ignore", invalid="ignore"):
            H[sound, j] = -(v[:, :i] / v[:, i:]).conj() * size[sound, i:] / size[sound, :i]
    return H


def _relative(coherence: np.ndarray) -> np.ndarray:
    """(1 - g2) (1 + g2) / (2 g2): phase that of H1, var ln|Hv| = (1 - g2) / 2 n since |Hv|^2 = Gyy / Gxx, whose logarithms have
    variance 1 / n each and covariance g2 / n (Bendat & Piersol, ch. 9)."""
    return (1 - coherence) * (1 + coherence) / (2 * coherence)


FRF_ESTIMATOR = FrfEstimator("hv", _estimate, _relative, "noise on forces and responses, in proportion to them")
