"""Hum, drift and offsets of channels: the mains and its multiples, and motion slower than channels are true, left out of fits.

Their amplitudes and phases are free in every stretch: y = simulated + Q c + e with a flat prior of c, Q (t, m) orthonormal. What is
compared are (1 - Q Q') y and (1 - Q Q') simulated, which is the likelihood with c integrated out.
"""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

_HIGHEST = 0.46  # of the sample rate: above, the band-limiting filter leaves nothing
BLOCK = 1024  # samples of a stretch where no fit states its own
_LEAKED = 8  # lines of a record on either side of one of the mains over which its end effects spread


@dataclass(frozen=True)
class Disturbance:
    """mains, drift: in Hz; 0 where there is none. offset: whether the zero of a channel is free in every stretch."""

    mains: float = 0.0
    drift: float = 0.0
    offset: bool = False

    def __bool__(self) -> bool:
        return bool(self.mains or self.drift or self.offset)

    def columns(self, count: int, dt: float) -> int:
        """How many amplitudes a stretch of `count` samples has free in each channel."""
        return _basis(self, count, dt).shape[1]

    def cleared(self, x: np.ndarray, dt: float, axis: int = 0) -> np.ndarray:
        """A stretch without them."""
        if not self:
            return x
        if not (self.mains or self.drift):
            return x - x.mean(axis=axis, keepdims=True)
        Q, y = _basis(self, x.shape[axis], dt), np.moveaxis(x, axis, 0)
        return np.moveaxis(y - np.tensordot(Q, np.tensordot(Q, y, (0, 0)), 1), 0, axis)

    def cleared_by(self, x: np.ndarray, dt: float, length: int) -> np.ndarray:
        """A record (t, s) without them, one stretch of about `length` samples after the other."""
        if not self:
            return x
        parts = np.array_split(x, max(len(x) // length, 1))
        return np.concatenate([self.cleared(part, dt) for part in parts])

    def lost(self, hz: np.ndarray) -> np.ndarray:
        """Mask (l,) of the lines of a spectrum that they take."""
        found, step = hz < self.drift, hz[1] if len(hz) > 1 else 0.0
        if self.mains:
            order = np.maximum(np.round(hz / self.mains), 1)
            found |= np.abs(hz - order * self.mains) <= _LEAKED * step
        return found


NONE = Disturbance()


@lru_cache(maxsize=16)
def _basis(own: Disturbance, count: int, dt: float) -> np.ndarray:
    """Q (count, m): cosines and sines of the mains; a straight line, and the cosines of half periods that are slow enough."""
    t = (np.arange(count) + 0.5) / count
    found = []
    if own.mains:
        angles = 2 * np.pi * np.outer(t * count * dt, np.arange(own.mains, _HIGHEST / dt, own.mains))
        found += [np.cos(angles), np.sin(angles)]
    if own.drift:
        half = np.arange(int(2 * own.drift * count * dt) + 1)
        found += [np.cos(np.pi * np.outer(t, half)), t[:, None]]
    elif own.offset:
        found.append(np.ones((count, 1)))
    return np.linalg.qr(np.concatenate(found, axis=1))[0]
