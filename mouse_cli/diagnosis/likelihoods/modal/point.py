"""What a model predicts at one place, and what its data leave there."""

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Point:
    """Model at x: all eigenvalues, shapes X (size, size), what sensors see of them (s, size), measured modes, residual, scales."""

    x: np.ndarray
    eigenvalues: np.ndarray
    X: np.ndarray
    seen: np.ndarray
    modes: np.ndarray
    residual: np.ndarray
    a: np.ndarray

    @property
    def chi2(self) -> float:
        """What is left of the data's misfit."""
        return float(self.residual @ self.residual)
