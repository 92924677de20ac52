"""Noise of the measured excitation: simulations repeat it as the structure amplifies it, and no initial state takes it.

With f + e read where f acts, e white, outputs that are simulated over a stretch err by G e, G their answers to a unit at each
sample. In the sd of the outputs the covariance of what is left is R + G Q G'. Its inverse square root is the innovations filter
of the structure begun at rest (T. Kailath, IEEE Trans. Autom. Control 13, 1968): the residual at each sample less its prediction
from those before it. Measured and simulated outputs are compared behind it.
"""

from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

_STEADY = 1e-12  # of a gain, by which it changes from sample to sample, from which on it is one


@dataclass(frozen=True, eq=False)
class Repeated:
    """States (m,) go from sample to sample by step (m, m); one sd of the noise of each excitation adds given (m, i) to them at its
    own sample. Outputs, in their sd or in their units (see `by`), have read (s, m) of the states and direct (s, i) of that noise;
    own (s,): variance of theirs beside it.
    """

    step: np.ndarray
    given: np.ndarray
    read: np.ndarray
    direct: np.ndarray
    own: np.ndarray

    def by(self, own: np.ndarray, sd: np.ndarray) -> "Repeated":
        """The same of outputs by sd (s,), with noise of sd own (s,) of theirs."""
        return replace(self, read=self.read / sd[:, None], direct=self.direct / sd[:, None], own=(own / sd) ** 2)

    def whitened(self, x: np.ndarray) -> np.ndarray:
        """Outputs (..., s, t, G) of stretches, in sd, as white noise of variance 1 beside the excitation's."""
        return self._passed(x, 0)

    def coloured(self, x: np.ndarray) -> np.ndarray:
        """The inverse: outputs (..., s, t, G) that `whitened` makes x."""
        return self._passed(x, 1)

    def _passed(self, x: np.ndarray, way: int) -> np.ndarray:
        if not self.given.size:
            return x
        s, m = self.read.shape
        y = np.moveaxis(x, -2, 0)
        many = np.moveaxis(y, -2, 1).reshape(len(y), s, -1)
        found, z = np.empty_like(many), np.zeros((m + s, many.shape[2]))
        filters = self._filters(len(y))[way]
        for k, now in enumerate(many):
            z[m:] = now
            after = filters[min(k, len(filters) - 1)] @ z
            z[:m], found[k] = after[:m], after[m:]
        shape = (len(y), s, *x.shape[:-3], x.shape[-1])
        return np.moveaxis(np.moveaxis(found.reshape(shape), 1, -2), 0, -2)

    @lru_cache(maxsize=8)  # noqa: B019 - lives as long as the study
    def _filters(self, t: int) -> tuple[np.ndarray, np.ndarray]:
        """(k, m + s, m + s) from the states and what goes in at a sample to the states at the next and what comes out, of the first
        k samples, the last of them for all that follow: to whiten, and back.
        """
        A, C, D = self.step, self.read, self.direct
        B = A @ self.given
        P, last, there, back = np.zeros_like(A), np.inf, [], []
        for _ in range(t):
            L = np.linalg.cholesky(C @ P @ C.T + D @ D.T + np.diag(self.own))
            gain = np.linalg.solve(L, (A @ P @ C.T + B @ D.T).T).T  # by what comes out
            white = np.linalg.inv(L)
            there.append(np.block([[A - gain @ white @ C, gain @ white], [-white @ C, white]]))
            back.append(np.block([[A, gain], [C, L]]))
            P = A @ P @ A.T + B @ B.T - gain @ gain.T
            P, size = (P + P.T) / 2, np.abs(gain).max()
            if np.abs(gain - last).max() <= _STEADY * size:
                break
            last = gain
        return np.array(there), np.array(back)


SILENT = Repeated(*(np.zeros((0, 0)),) * 4, np.zeros(0))
