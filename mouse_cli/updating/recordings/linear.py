"""The linear model of a deck and what is uncertain in it: the deck's own parameters, and stiffness and damping of each part."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

_STEP = 1e-6  # of a factor


def rigid(K: np.ndarray, M: np.ndarray, seconds: float) -> np.ndarray:
    """Motions (n, r) that K (n, n) does not hold: slower than so many seconds a period."""
    from scipy.linalg import eigh

    values, shapes = eigh(K, M)
    return shapes[:, values < (2 * np.pi / seconds) ** 2]


@dataclass(frozen=True)
class Linear:
    """M, C, K (n, n) at the prior mean, and k nuisances with a standard normal prior.

    matrices(z (P, k)) gives M, C, K (P, n, n); slopes: their derivatives dM, dC, dK (k, n, n) at the mean. names (k,).
    scaled(z (k,), s): nuisances of the same model with M, C and K s times as large; None where they do not make one.
    by_modes(z (P, k)): what of C (P, n, n) is damping by modes; None where nothing is.
    """

    M: np.ndarray
    C: np.ndarray
    K: np.ndarray
    matrices: Callable[[np.ndarray], tuple[np.ndarray, np.ndarray, np.ndarray]]
    slopes: tuple[np.ndarray, np.ndarray, np.ndarray]
    names: tuple[str, ...]
    scaled: Callable[[np.ndarray, float], np.ndarray | None] = lambda z, s: None
    by_modes: Callable[[np.ndarray], np.ndarray] | None = None

    @property
    def common(self) -> np.ndarray:
        """How nuisances (k,) begin to move from the mean where M, C and K grow alike; zeros where they cannot."""
        step = self.scaled(np.zeros(self.k), 1 + _STEP)
        return np.zeros(self.k) if step is None else step / _STEP

    def sound(self, z: np.ndarray) -> bool:
        """Whether at z (k,) every motion has inertia, and stiffness unless it has none at the mean."""
        M, _, K = (one[0] for one in self.matrices(z[None]))
        least = lambda matrix: float(np.linalg.eigvalsh(matrix)[0])
        return least(M) > 0 and least(K) >= min(least(self.K), 0.0) - 1e-9 * float(np.abs(self.K).max())

    @property
    def k(self) -> int:
        """Number of nuisances."""
        return len(self.names)
