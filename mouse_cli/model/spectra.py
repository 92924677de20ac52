"""From recordings to frequency response functions: how, and what came of it; reports read it and compute nothing."""

from dataclasses import dataclass

from mouse_cli._errors import Diagnostic
from mouse_cli._notebook import Shown
from mouse_cli.model import block_window
from mouse_cli.model.frf_test import FrfTest

WINDOWS = (*block_window.WINDOWS, "exponential")
STROKES = ("uniform", "exponential")  # windows that leave a stroke at the beginning of a block as it is
ESTIMATORS = ("h1", "h2", "hv")
FOUND = -1  # as force_window: its length is found in the strokes


@dataclass(frozen=True)
class SpectraOptions:
    """How recordings become frequency response functions; every field is an option of `mouse spectra`.

    window: of each block, one of WINDOWS; None: uniform for strokes, which a taper would weaken at the beginning of their
    block, else hann. lines: spectral lines above 0 Hz, half the samples of a block; None: so many that there are 16 blocks or
    more. overlap: of blocks, 0 to below 1; None: 0.5, and 0 for the windows uniform and exponential. final: value of the
    exponential window at the end of the block. period: samples of a periodic excitation; with it there is neither window nor
    overlap, and the noise is that between periods. skip: samples left out at the beginning. impact: blocks begin before each
    stroke of a hammer, pretrigger: so many samples before. force_window: samples from the beginning of such a block after which
    the force is taken to be 0, FOUND or None: no such window. kind: of the functions, None: that of the first response.
    """

    estimator: str = "h1"
    window: str | None = None
    lines: int | None = None
    overlap: float | None = None
    final: float = 0.01
    period: int | None = None
    skip: int = 0
    impact: bool = False
    pretrigger: int = 10
    force_window: int | None = None
    kind: str | None = None

    @property
    def taken(self) -> str:
        """The window that is used."""
        return self.window or ("uniform" if self.impact else "hann")

    @property
    def shared(self) -> float:
        """The overlap that is used."""
        if self.overlap is not None:
            return self.overlap
        return 0.0 if self.taken in STROKES else 0.5


@dataclass(frozen=True)
class Quality:
    """How good one function is. lines: with a value; median_coherence, median_noise: sd of the magnitude by it; NaN where unknown.

    peak_hz: where its magnitude is largest.
    """

    response: str
    force: str
    lines: int
    median_coherence: float
    median_noise: float
    peak_hz: float


@dataclass(frozen=True)
class MeasuredFrf:
    """Functions and how they were averaged. averages: effective number of independent blocks; blocks: of which they were made.

    recordings: their titles. quality: of each function, those of one force after another. force_window: samples of it, 0 without.
    """

    frf: FrfTest
    averages: float
    blocks: int
    block_samples: int
    sample_rate_hz: float
    recordings: tuple[str, ...] = ()
    quality: tuple[Quality, ...] = ()
    force_window: int = 0


@dataclass(frozen=True)
class SpectraResult(Shown):
    """What `mouse spectra` found: one item for each set of recordings with the same channels."""

    title: str
    source: str
    options: SpectraOptions
    measured: tuple[MeasuredFrf, ...]
    warnings: tuple[Diagnostic, ...] = ()
