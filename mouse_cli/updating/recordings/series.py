"""A record prepared for comparison with simulations: band-limited, cut into segments, with the accuracy of each channel."""

from dataclasses import dataclass, replace
from functools import cached_property, lru_cache

import numpy as np

from mouse_cli.updating.recordings.disturbance import NONE, Disturbance
from mouse_cli.updating.recordings.excitation_noise import SILENT, Repeated

REACH = 12  # samples on either side that the band-limiting filter takes in
_EDGE, _WINDOW = 0.42, 6.0  # its edge by the sample rate; parameter of its Kaiser window
_COARSER = 4  # steps of what is compared in one of slopes


@dataclass(frozen=True)
class Series:
    """t samples of one record, dt apart in s. force (t, i), measured (t, s); sd (s,) of the noise; factor: steps in a sample;
    coarsest: least of them that no mode of the model is folded into the band by.

    inputs (n, i), sensing (s, n): how they meet the model; order (s,): 0 displacement, 1 velocity, 2 acceleration. base (n, i): how
    the ground carries it along, where `force` is its acceleration; motions are then relative to it, and `inputs` 0; carried (s, i):
    how much of `force` was taken off outputs for that. floor (s,): of the noise, as the spectrum shows it, where sd is more;
    force_noise (i,): sd of that of the columns of `force`, and what simulations make of it, `repeated`; acts
    (t, i): when it acts, None: all the time.
    free: whether the initial state alone moves it. disturbance: of the outputs, which no fit sees.
    slow: samples over which motions are free in a fit that no force makes, of a structure that nothing holds; 0 where all die away.
    """

    title: str
    dt: float
    force: np.ndarray
    measured: np.ndarray
    sd: np.ndarray
    inputs: np.ndarray
    sensing: np.ndarray
    order: np.ndarray
    base: np.ndarray
    factor: int = 4
    coarsest: int = 4
    first: int = 0
    floor: np.ndarray | None = None
    force_noise: np.ndarray | None = None
    repeated: Repeated = SILENT
    acts: np.ndarray | None = None
    slow: int = 0
    free: bool = False
    disturbance: Disturbance = NONE
    carried: np.ndarray | float = 0.0

    def __len__(self) -> int:
        return len(self.measured)

    def part(self, begin: int, end: int) -> "Series":
        """Samples begin to end."""
        acts = None if self.acts is None else self.acts[begin:end]
        own = {"force": self.force[begin:end], "measured": self.measured[begin:end], "acts": acts}
        return replace(self, **own, first=self.first + begin)

    def loads(self, M: np.ndarray) -> np.ndarray:
        """What a unit of each column of `force` does to the model with the mass matrix M (..., n, n): P - M J (..., n, i)."""
        return self.inputs - M @ self.base

    @property
    def at_rest(self) -> bool:
        """Whether the record begins before anything moves."""
        size = np.sqrt((self.measured**2).mean(axis=0))
        return bool((np.abs(self.measured[:3]) < 5 * self.sd + 1e-3 * size).all()) and self.first == 0

    @property
    def adrift(self) -> bool:
        """Whether no channel shows the speed of a structure that nothing holds."""
        return bool(self.slow and (self.order == 2).all())

    @cached_property
    def fine(self) -> np.ndarray:
        """The force (t * factor, i) at every step, band-limited between samples."""
        if not self.force.shape[1]:
            return np.zeros((len(self) * self.factor, 0))
        from scipy.signal import firwin, resample_poly

        filter = firwin(2 * 24 * self.factor + 1, 1 / self.factor, window=("kaiser", 8.0))
        return resample_poly(self.force, self.factor, 1, axis=0, window=filter, padtype="line")

    @cached_property
    def coarser(self) -> "Series":
        """The same in fewer steps, for slopes: they need not be as exact as what is compared."""
        return replace(self, factor=min(self.factor, max(self.factor // _COARSER, self.coarsest)))

    @cached_property
    def filtered(self) -> np.ndarray:
        """Measured channels (t, s), limited to the band in which simulations are compared with them."""
        from scipy.signal import oaconvolve

        return oaconvolve(self.measured, limiter(1)[:, None], mode="same", axes=0)


def limiter(factor: int) -> np.ndarray:
    """The band-limiting filter at `factor` steps a sample."""
    from scipy.signal import firwin

    return firwin(2 * REACH * factor + 1, 2 * _EDGE / factor, window=("kaiser", _WINDOW))


def quick(x: np.ndarray, order: np.ndarray, samples: int) -> np.ndarray:
    """Channels x (t, s) without what places and speeds of so many samples make of them: displacements are taken twice about their
    mean under a Hann window, velocities once, accelerations as they are; order (s,). Wrong within so many samples of either end.
    """
    from scipy.signal import oaconvolve

    half = samples // 2
    window = np.hanning(2 * half + 3)[1:-1, None]
    window /= window.sum()
    for least in (0, 1):
        own = order <= least
        x = np.where(own, x - oaconvolve(x, window, mode="same", axes=0), x) if own.any() else x
    return x


def passed() -> float:
    """Share of white noise that the band-limiting filter leaves."""
    return float((limiter(1) ** 2).sum())


@np.errstate(over="ignore", invalid="ignore")  # simulations may diverge
def sampled(fine: np.ndarray, factor: int) -> np.ndarray:
    """Simulated channels (P, s, t * factor, G), band-limited and at the samples; REACH samples at either end are lost.

    Blocks of samples are products with one banded matrix, which are much faster than a filter along an inner axis.
    """
    count = (fine.shape[2] - 1) // factor + 1 - 2 * REACH
    found = np.empty((*fine.shape[:2], max(count, 0), fine.shape[3]))
    for begin in range(0, count, 2 * REACH):
        end = min(begin + 2 * REACH, count)
        banded = _banded(factor, end - begin)
        steps = slice(begin * factor, begin * factor + banded.shape[1])
        np.matmul(banded, fine[:, :, steps], out=found[:, :, begin:end])
    return found


@lru_cache(maxsize=64)
def _banded(factor: int, samples: int) -> np.ndarray:
    """The band-limiting filter (samples, steps) at samples that follow one another."""
    own = limiter(factor)
    found = np.zeros((samples, (samples - 1) * factor + len(own)))
    for row in range(samples):
        found[row, row * factor :][: len(own)] = own
    return found
