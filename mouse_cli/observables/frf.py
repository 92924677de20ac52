"""Frequency response functions as observable, in one of FORMS, at chosen lines.

complex: real and imaginary part of H, each with half of its variance. log: ln|H|, to first order with sd(ln|H|) = sd(Re H) / |H|
(delta method); log-phase: that and the phase of H with the same standard deviation. In these two a value that is no larger than
its own noise is left out: its logarithm tells of the noise. What is NaN, or known to no accuracy (coherence 0), is left out always.
"""

from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from mouse_cli.model.frf_test import KINDS, FrfTest
from mouse_cli.observables.frf_leakage import AtNodes, Leakage, of_window

# Standard deviation of real and imaginary part where none is known: root of the sum of squares of these shares.
ASSUMED_OF_MAGNITUDE = 0.05  # of the value's own magnitude
ASSUMED_OF_MEDIAN = 0.01  # of the median magnitude of its function
LEAST = 1e-3  # no value is held to be known better than to this share of its magnitude


@dataclass(frozen=True)
class FrfObservable(AtNodes):
    """The values of `test` in `form` at its `lines` (l,), from 0; q data.

    H (l, o, i), sd (l, o, i): as fitted, and standard deviation of its real and of its imaginary part. have (l, o, i): what is
    fitted. width: it was taken at s = (i + width) omega, see `frf_smoothing`; 0: as measured. assumed: where no accuracy was known.
    """

    test: FrfTest
    form: str
    lines: np.ndarray
    H: np.ndarray
    sd: np.ndarray
    have: np.ndarray
    width: float = 0.0
    assumed: bool = False

    @property
    def s(self) -> np.ndarray:
        """Where on the complex plane (l,), rad/s."""
        return self.test.laplace[self.lines] + self.width * self.test.omega[self.lines]

    @cached_property
    def leakage(self) -> Leakage | None:
        """What H1 makes of the functions of a model; None: nothing, as of those that were smoothed, whose resonances are broad."""
        return None if self.width else of_window(self.test, self.s)

    def expected(self, receptance: np.ndarray) -> np.ndarray:
        """What is measured (l, o, i, ...) of a receptance (n, o, i, ...) at the nodes, but for noise."""
        return super().expected(receptance * self.factor.reshape(-1, *[1] * (receptance.ndim - 1)))

    def __len__(self) -> int:
        return int(self.have.sum()) * (1 if self.form == "log" else 2)

    def measured(self) -> tuple[np.ndarray, np.ndarray]:
        """y (q,) and its standard deviations (q,)."""
        own, sd = self.H[self.have], self.sd[self.have]
        if self.form == "complex":
            return np.concatenate([own.real, own.imag]), np.tile(sd, 2)
        sd = sd / np.abs(own)
        if self.form == "log":
            return np.log(np.abs(own)), sd
        return np.concatenate([np.log(np.abs(own)), np.angle(own)]), np.tile(sd, 2)

    def predicted(self, receptance: np.ndarray) -> np.ndarray:
        """The data (q,) of a model with this receptance (n, o, i); phases are those nearest to the measured ones."""
        own = self.expected(receptance)[self.have]
        if self.form == "complex":
            return np.concatenate([own.real, own.imag])
        size = np.log(np.maximum(np.abs(own), 1e-300))
        if self.form == "log":
            return size
        measured = self.H[self.have]
        return np.concatenate([size, np.angle(measured) + np.angle(own / measured)])

    def partials(self, receptance: np.ndarray, slopes: Iterable[tuple[slice, np.ndarray]], p: int) -> np.ndarray:
        """T (q, p) from d receptance (n, o, i, p'), some parameters at a time."""
        T, half = np.empty((len(self), p)), int(self.have.sum())
        scale = 1.0 if self.form == "complex" else 1 / self.expected(receptance)[self.have][:, None]  # d ln H = dH / H
        for part, change in slopes:
            own = self.expected(change)[self.have] * scale
            T[:half, part] = own.real
            if self.form != "log":
                T[half:, part] = own.imag
        return T

    def labels(self) -> list[str]:
        """Names of the data, as `Re H(3TX,1TX) at 6.5 Hz`."""
        test = self.test
        hz = [f"{value:.6g}" for value in test.frequency_hz[self.lines]]
        outputs, inputs = names(test)
        at = [f"H({outputs[o]},{inputs[i]}) at {hz[k]} Hz" for k, o, i in np.argwhere(self.have).tolist()]
        kinds = {"complex": ("Re", "Im"), "log": ("ln",), "log-phase": ("ln", "arg")}[self.form]
        return [f"{kind} {place}" for kind in kinds for place in at]


def names(test: FrfTest) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """What the responses and the forces are called; their numbers where the deck gives no names."""
    outputs = test.output_names or tuple(str(k + 1) for k in range(test.H.shape[1]))
    return outputs, test.input_names or tuple(str(k + 1) for k in range(test.H.shape[2]))


def observe(test: FrfTest, form: str, lines: np.ndarray | None = None) -> FrfObservable:
    """The observable of `test` at `lines` (default: `chosen`)."""

    sd, assumed = accuracy(test)
    have = usable(test, sd, form)
    lines = chosen(test, have, test.lines) if lines is None else lines
    return FrfObservable(test, form, lines, test.H[lines], sd[lines], have[lines], assumed=assumed)


def accuracy(test: FrfTest) -> tuple[np.ndarray, bool]:
    """Standard deviation (f, o, i) of real and imaginary part, as measured or assumed; and whether any had to be assumed."""
    size = np.abs(test.H)
    with np.errstate(invalid="ignore"):
        sd = np.sqrt(test.variance / 2)
        unknown = np.isnan(sd) & np.isfinite(size)
        if unknown.any():
            measured = np.where(np.isfinite(size), size, np.nan)
            measured[:, np.isnan(measured).all(axis=0)] = 0.0  # functions that were not measured
            sd = np.where(unknown, _assumed(size, measured), sd)
        return np.maximum(sd, LEAST * size), bool(unknown.any())


def _assumed(size: np.ndarray, measured: np.ndarray) -> np.ndarray:
    """Standard deviation (f, o, i) where none is known; measured: the magnitudes with NaN where there is none."""
    return np.hypot(ASSUMED_OF_MAGNITUDE * size, ASSUMED_OF_MEDIAN * np.nanmedian(measured, axis=0))


def usable(test: FrfTest, sd: np.ndarray, form: str) -> np.ndarray:
    """Mask (f, o, i) of the values that say something in that form."""
    size = np.abs(test.H)
    with np.errstate(invalid="ignore"):
        have = np.isfinite(test.H) & np.isfinite(sd) & (sd > 0) & (test.frequency_hz > 0)[:, None, None]
        return have if form == "complex" else have & (size**2 > 2 * sd**2)


def chosen(test: FrfTest, have: np.ndarray, most: int) -> np.ndarray:
    """Indices, ascending, of at most `most` lines at which anything of `have` (f, o, i) stands; all where these are no more.

    Half of them lie evenly over the band, half at equal shares of the area beneath the mean magnitude of mobility, each function
    scaled by its own area. Mobility peaks at every resonance as 1/(2 zeta omega m) over a width of 2 zeta omega, so that each gets
    about as many lines, however narrow; what a line says of frequencies and damping is most there.
    """
    lines = np.flatnonzero(have.any(axis=(1, 2)))
    if len(lines) <= most:
        return lines
    size = np.where(have, np.abs(np.where(have, test.H, 0.0)), 0.0)[lines]
    mobility = size * (test.omega[lines] ** (1.0 - KINDS[test.kind]))[:, None, None]
    area = mobility.sum(axis=0)
    peaks = np.divide(mobility, area, out=np.zeros_like(mobility), where=area > 0).sum(axis=(1, 2))
    density = 0.5 / len(lines) + 0.5 * peaks / peaks.sum()
    return lines[_spread(density, most)]


def _spread(density: np.ndarray, most: int) -> np.ndarray:
    """`most` different places, spaced in proportion to 1 / density; none is more than one."""
    density = density * most / density.sum()
    while True:  # a line counts once, however dense: what is cut off goes to the others
        full = density >= 1.0
        rest = most - full.sum()
        scaled = np.where(full, 1.0, density * rest / max(density[~full].sum(), 1e-300))
        if np.allclose(scaled, density):
            break
        density = scaled
    edges = np.floor(np.cumsum(density) + 0.5 - 1e-9)
    return np.flatnonzero(np.diff(np.concatenate([[0.0], edges])) > 0)
