"""Noise of the measured excitation: simulations repeat it as the structure amplifies it, and no initial state takes it.

With f + e read where f acts, e white of covariance Q, outputs that are simulated over a stretch err by G e, G their answers to a
unit at each sample. In the sd of the outputs the covariance of what is left is I + G Q G' = I + U diag(lambda) U', of few
directions U that count beside I: those of resonances. Measured and simulated outputs are compared times (I + U lambda U')^-1/2.
"""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

_LEAST = 0.05  # variance by that of the outputs from which on a direction counts
_MOST = 192  # directions
_PRECISE = 1e-3  # of those variances


@dataclass(frozen=True, eq=False)
class Repeated:
    """pulses (t, s, i): answers of outputs, in their sd, to one sd of the noise of each excitation at the first sample; none:
    there is no such noise.
    """

    pulses: np.ndarray

    def whitened(self, x: np.ndarray, power: float = -0.5) -> np.ndarray:
        """Outputs (..., s, t, G) of stretches, in sd, times that power of I + U lambda U'."""
        if not self.pulses.size:
            return x
        U, lam = self._directions(x.shape[-2])
        s, t, G = x.shape[-3:]
        flat = x.reshape(-1, s * t, G)
        flat = flat + U @ (((1 + lam) ** power - 1)[:, None] * (U.T @ flat))
        return flat.reshape(x.shape)

    @lru_cache(maxsize=8)  # noqa: B019 - lives as long as the study
    def _directions(self, t: int) -> tuple[np.ndarray, np.ndarray]:
        """U (st, r) and lambda (r,) for stretches of t samples."""
        from scipy.sparse.linalg import LinearOperator, eigsh

        s, H = self.pulses.shape[1], np.fft.rfft(self.pulses[:t], 2 * t, axis=0)

        def applied(y: np.ndarray) -> np.ndarray:
            Y = np.fft.rfft(y.reshape(s, t).T, 2 * t, axis=0)
            e = np.fft.irfft(np.einsum("lsi,ls->li", H.conj(), Y), 2 * t, axis=0)[:t]
            E = np.fft.rfft(e, 2 * t, axis=0)
            return np.fft.irfft(np.einsum("lsi,li->ls", H, E), 2 * t, axis=0)[:t].T.ravel()

        operator = LinearOperator((s * t, s * t), applied, dtype=float)
        begin = np.random.default_rng(0).standard_normal(s * t)
        lam, U = eigsh(operator, min(_MOST, s * t - 1), tol=_PRECISE, v0=begin)
        return U[:, lam > _LEAST], lam[lam > _LEAST]


SILENT = Repeated(np.zeros((0, 0, 0)))
