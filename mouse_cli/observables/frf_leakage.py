"""What H1 of windowed blocks is expected to be, of a model that is solved at nodes beside the lines.

The impulse response is multiplied by the lag window r(tau) of the blocks, see `records.leakage`. Over p blocks r e^(sigma tau) is a
Fourier series, so that for tau >= 0

    r(tau) = e^(-sigma tau) sum_k c_k e^(2 pi i k tau / pT),    H1(s) = sum_k c_k H(s + sigma - 2 pi i k / pT)

(the theorem of damping of the Laplace transform): a sum over models at parts of lines, farther from their resonances. No pole is
needed, and any damping is allowed. What the series repeats after p blocks is less by e^(-p sigma T). Below zero H(-i nu) is the
conjugate. A lag window that ends with a bend or a step has a longer series, and takes more blocks.
"""

from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np

from mouse_cli.dynamics.frf import kind_factor
from mouse_cli.model.arrays import Matrix
from mouse_cli.model.block_window import BlockWindow
from mouse_cli.model.frf_test import KINDS, FrfTest
from mouse_cli.records.leakage import lags

_DECAY = 9.0  # p sigma T
_BLOCKS = {"uniform": 4}  # p where it is not 2
_FINE, _WIDEST = 1e-4, 24  # |c_k| over the largest that is left out, and lines to either side at most


@dataclass(frozen=True)
class Leakage:
    """nodes (n,): s, rad/s, at which the model is solved; above, below (l, n): weights of H there and of its conjugate."""

    nodes: np.ndarray
    above: Matrix
    below: Matrix

    def expected(self, H: np.ndarray) -> np.ndarray:
        """H1 (l, ...) of functions H (n, ...), linear in their real and imaginary parts."""
        flat = H.reshape(len(H), int(np.prod(H.shape[1:])))
        return (self.above @ flat + self.below @ flat.conj()).reshape(self.above.shape[0], *H.shape[1:])


class AtNodes:
    """Lines s (l,), rad/s, of a measurement `test`, as a model is solved for them; leakage: what H1 makes of it, None: nothing."""

    test: FrfTest
    s: np.ndarray
    leakage: Leakage | None

    @property
    def nodes(self) -> np.ndarray:
        """Where the model is solved (n,), rad/s."""
        return self.leakage.nodes if self.leakage else self.s

    @cached_property
    def factor(self) -> np.ndarray:
        """What receptance is multiplied by at the nodes (n, 1, 1)."""
        return kind_factor(KINDS[self.test.kind], self.nodes)

    def expected(self, H: np.ndarray) -> np.ndarray:
        """What was measured (l, ...) of functions H (n, ...) at the nodes, but for noise."""
        return self.leakage.expected(H) if self.leakage else H


def of_window(test: FrfTest, s: np.ndarray) -> Leakage | None:
    """That of a measurement at lines s (l,), rad/s; None where its functions are those of the structure itself."""
    return None if test.window is None else leakage(test.window, s)


def leakage(window: BlockWindow, s: np.ndarray) -> Leakage:
    """That of lines s (l,), rad/s, of one real part."""
    from scipy.sparse import csr_array

    k, weights, blocks = _series(window.name, window.burst)
    step = 2 * np.pi / (blocks * window.seconds)
    omega = s.imag[:, None] - step * k
    steps, at = np.unique(np.round(np.abs(omega) / step, 6), return_inverse=True)
    at, row = at.reshape(omega.shape), np.broadcast_to(np.arange(len(s))[:, None], omega.shape)
    parts = []
    for chosen in (omega >= 0, omega < 0):
        values = np.broadcast_to(weights, omega.shape)[chosen]
        parts.append(csr_array((values, (row[chosen], at[chosen])), shape=(len(s), len(steps))))
    sigma = _DECAY / (blocks * window.seconds)
    return Leakage(s.real.max(initial=0.0) + sigma + 1j * step * steps, *parts)


@lru_cache
def _series(name: str, burst: float) -> tuple[np.ndarray, np.ndarray, int]:
    """k and c_k of the Fourier series of r e^(sigma tau) over p blocks, their sum r(0) = 1; and p.

    Before 0, where no response is, r goes on as smoothly as it begins: mirrored, or, of a slope, on and out within a block.
    """
    r = lags(BlockWindow(name, 1.0, burst))
    b, p = len(r), _BLOCKS.get(name, 2)
    n = p * b
    tau, whole = np.fft.fftfreq(n) * p, np.zeros(n)
    before = r if p == 2 else (2 - r) * (1 + np.cos(np.pi * tau[:b])) / 2
    whole[:b], whole[-b + 1 :] = r, before[:0:-1]
    c = np.fft.fft(whole * np.exp(_DECAY / p * tau)) / n
    k = np.rint(np.fft.fftfreq(n) * n).astype(int)
    large = np.abs(k[np.abs(c) > _FINE * np.abs(c).max()]).max()
    most = min(large, p * _WIDEST)
    kept = np.abs(k) <= most
    k, c = k[kept], c[kept]
    if large > most:
        c = c * np.sinc(k / (most + 1))  # Lanczos' factors, where the series is cut off
    return k, c / c.sum(), p
