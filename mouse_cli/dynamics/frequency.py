"""Between eigenvalues in (rad/s)^2 and natural frequencies in Hz, with their standard deviations to first order."""

import numpy as np


def eigenvalue(hz: np.ndarray) -> np.ndarray:
    """lambda = (2 pi f)^2.

    >>> round(float(eigenvalue(1.0)), 6)
    39.478418
    """
    return (2 * np.pi * hz) ** 2


def frequency_hz(eigenvalue: np.ndarray) -> np.ndarray:
    """f = sqrt(lambda) / 2 pi; 0 for an eigenvalue that is negative by rounding."""
    return np.sqrt(np.maximum(eigenvalue, 0.0)) / (2 * np.pi)


def sd_eigenvalue(hz: np.ndarray, sd_hz: np.ndarray) -> np.ndarray:
    """sd_lambda = 8 pi^2 f sd_f."""
    return 8 * np.pi**2 * hz * sd_hz


def sd_frequency_hz(hz: np.ndarray, sd_eigenvalue: np.ndarray) -> np.ndarray:
    """sd_f = sd_lambda / (8 pi^2 f); not finite where f is 0, for there the relation has no first order."""
    with np.errstate(divide="ignore", invalid="ignore"):
        return sd_eigenvalue / (8 * np.pi**2 * np.asarray(hz))
