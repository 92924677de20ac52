"""Noise of the measured excitation: simulations repeat it as the structure amplifies it, and no initial state takes it.

With f + e read where f acts, e white, outputs that are simulated over a stretch err by G e, G their answers to a unit at each
sample. In the sd of the outputs the covariance of what is left is R + G Q G'. Its inverse square root is the innovations filter
of the structure begun at rest (T. Kailath, IEEE Trans. Autom. Control 13, 1968): the residual at each sample less its prediction
from those before it. Measured and simulated outputs are compared behind it.
"""

from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

_MOST = 2e7  # numbers in the filters of stretches in which noise acts at times; beyond, it acts all the time
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

    def over(self, t: int, acts: np.ndarray | None = None) -> "Whitening | None":
        """The innovations filter of stretches of t samples; acts (t, i, G): by how much the noise acts at each sample of G
        stretches, None: all the time. None: there is no such noise.
        """
        if not self.given.size:
            return None
        if acts is None or acts.shape[2] * t * sum(self.read.shape) ** 2 > _MOST:
            return Whitening(*(each[:, None] for each in self._filters(t)))
        each = [self._gains(t, own) for own in np.moveaxis(acts, 2, 0)]
        last = max(len(there) for there, _ in each)
        longer = lambda own: np.concatenate([own, np.repeat(own[-1:], last - len(own), 0)])
        return Whitening(*(np.stack([longer(own[way]) for own in each], 1) for way in (0, 1)))

    @lru_cache(maxsize=8)  # noqa: B019 - lives as long as the study
    def _filters(self, t: int) -> tuple[np.ndarray, np.ndarray]:
        return self._gains(t, np.ones((t, self.given.shape[1])))

    def _gains(self, t: int, acts: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """(k, m + s, m + s) from the states and what goes in at a sample to the states at the next and what comes out, of the first
        k samples, the last of them for all that follow: to whiten, and back. acts (t, i): as in `over`, of one stretch.
        """
        A, C = self.step, self.read
        same = int(np.flatnonzero((acts != acts[-1]).any(axis=1)).max(initial=-1)) + 1  # it acts as at the end from there on
        P, last, largest, there, back = np.zeros_like(A), np.inf, 0.0, [], []
        for k in range(t):
            B, D = A @ self.given * acts[k], self.direct * acts[k]
            L = np.linalg.cholesky(C @ P @ C.T + D @ D.T + np.diag(self.own))
            gain = np.linalg.solve(L, (A @ P @ C.T + B @ D.T).T).T  # by what comes out
            white = np.linalg.inv(L)
            there.append(np.block([[A - gain @ white @ C, gain @ white], [-white @ C, white]]))
            back.append(np.block([[A, gain], [C, L]]))
            P = A @ P @ A.T + B @ B.T - gain @ gain.T
            P, largest = (P + P.T) / 2, max(largest, np.abs(gain).max())
            if k >= same and np.abs(gain - last).max() <= _STEADY * largest:
                break
            last = gain
        return np.array(there), np.array(back)


@dataclass(frozen=True, eq=False)
class Whitening:
    """Filters (k, 1 or G, m + s, m + s) of the first k samples of stretches, the last of them for all that follow: to white noise
    of variance 1 beside the excitation's, and back.
    """

    there: np.ndarray
    back: np.ndarray

    @property
    def stretches(self) -> int:
        """Of how many they are; 1: of all alike."""
        return self.there.shape[1]

    def whitened(self, x: np.ndarray) -> np.ndarray:
        """Outputs (..., s, t, G) of stretches, in sd, as white noise."""
        return _passed(self.there, x)

    def coloured(self, x: np.ndarray) -> np.ndarray:
        """The inverse: outputs (..., s, t, G) that `whitened` makes x."""
        return _passed(self.back, x)


def _passed(filters: np.ndarray, x: np.ndarray) -> np.ndarray:
    s, t, G = x.shape[-3:]
    m, own = filters.shape[2] - s, filters.shape[1]
    # (t, 1 or G, s, all else)
    y = np.moveaxis(x, (-2, -1, -3), (0, 1, 2)).reshape(t, G, s, -1)
    many = np.ascontiguousarray(y if own > 1 else np.moveaxis(y, 1, 2).reshape(t, 1, s, -1))
    found, z = np.empty_like(many), np.zeros((own, m + s, many.shape[3]))
    for k, now in enumerate(many):
        z[:, m:] = now
        after = filters[min(k, len(filters) - 1)] @ z
        z[:, :m], found[k] = after[:, :m], after[:, m:]
    found = found if own > 1 else np.moveaxis(found.reshape(t, s, G, -1), 2, 1)
    return np.moveaxis(found.reshape(t, G, s, *x.shape[:-3]), (0, 1, 2), (-2, -1, -3))


SILENT = Repeated(*(np.zeros((0, 0)),) * 4, np.zeros(0))
