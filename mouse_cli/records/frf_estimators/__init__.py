"""Estimators of frequency response functions from mean products of spectra: one file = one estimator."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from mouse_cli import _registry
from mouse_cli.records.blocks import Products


@dataclass(frozen=True)
class FrfEstimator:
    """estimate(products) gives H (f, o, i); relative_variance(coherence) that of n averages for one force, times n.

    single: whether it is defined for one force alone. where: which channels it takes to be noisy, for the report.
    """

    key: str
    estimate: Callable[[Products], np.ndarray]
    relative_variance: Callable[[np.ndarray], np.ndarray]
    where: str
    single: bool = False


def estimator(key: str) -> FrfEstimator:
    """The estimator called `key`. Raises ValueError that lists the known ones."""
    return _registry.member(__name__, "FRF_ESTIMATOR", key, "estimator of functions")


def inverse(Gxx: np.ndarray) -> np.ndarray:
    """Gxx^-1 (f, i, i), inputs brought to one size first; NaN at lines where they are not independent."""
    size = np.sqrt(np.einsum("fii->fi", Gxx).real)
    with np.errstate(divide="ignore", invalid="ignore"):
        scaled = Gxx / (size[:, :, None] * size[:, None, :])
    sound = np.isfinite(scaled).all(axis=(1, 2))
    values = np.full(Gxx.shape, np.nan, complex)
    if sound.any():
        smallest = np.linalg.eigvalsh(scaled[sound])[:, 0]
        sound[sound] = smallest > 1e-10
        values[sound] = np.linalg.inv(scaled[sound])
    with np.errstate(divide="ignore", invalid="ignore"):
        return values / (size[:, :, None] * size[:, None, :])


def multiple_coherence(products: Products) -> np.ndarray:
    """g2 = Gyx Gxx^-1 Gxy / Gyy (f, o), from 0 to 1 (Bendat & Piersol, Random Data, ch. 7); ordinary for one force."""
    explained = np.einsum("foi,fij,foj->fo", products.Gyx, inverse(products.Gxx), products.Gyx.conj()).real
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.clip(explained / products.Gyy, 0.0, 1.0)


def variance(chosen: FrfEstimator, H: np.ndarray, products: Products, coherence: np.ndarray) -> np.ndarray:
    """E|H - mean|^2 (f, o, i) = Gyy (1 - g2) [Gxx^-1]_ii / (n - i) of n averages and i forces; NaN where n <= i.

    Regression of complex amplitudes: n - i of them are left for the noise. For one force this is |H|^2 (1 - g2) / (g2 (n - 1)),
    Bendat & Piersol, ch. 9, for large n. H2 and Hv have for one force their own, for more that of H1.
    """
    i = products.Gxx.shape[1]
    if products.averages <= i:
        return np.full(H.shape, np.nan)
    if i == 1:
        with np.errstate(divide="ignore", invalid="ignore"):
            return np.abs(H) ** 2 * (chosen.relative_variance(coherence) / (products.averages - 1))[:, :, None]
    noise = products.Gyy * (1 - coherence) / (products.averages - i)
    return noise[:, :, None] * np.einsum("fii->fi", inverse(products.Gxx)).real[:, None, :]
