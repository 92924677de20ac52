"""What modal identification found in recordings or frequency response functions; reports read it and compute nothing."""

from dataclasses import dataclass, field

import numpy as np

from mouse_cli._errors import Diagnostic
from mouse_cli._notebook import Shown
from mouse_cli.model.arrays import Matrix, dense
from mouse_cli.model.modal_test import ModalTest
from mouse_cli.model.problem import Problem

UNIT_MASS, UNIT_LARGEST = "unit modal mass", "largest component 1"


@dataclass(frozen=True)
class Rejected:
    """A pole that is no mode of the answer, and why."""

    frequency_hz: float
    damping: float
    reason: str


@dataclass(frozen=True)
class Diagram:
    """The stabilisation diagram: order (k,), frequency (k,) Hz, damping (k,) and whether stable (k,) of every damped pole.

    level (f,): what was measured over frequency_hz (f,), one curve for all channels, for its background.
    """

    order: np.ndarray
    frequency_hz: np.ndarray
    damping: np.ndarray
    stable: np.ndarray
    line_hz: np.ndarray
    level: np.ndarray


@dataclass(frozen=True)
class FrfFit:
    """Measured and fitted H (f, o, i) at frequency_hz (f,), with the sd (f, o, i) of the measured ones that the fit used."""

    frequency_hz: np.ndarray
    measured: np.ndarray
    fitted: np.ndarray
    sd: np.ndarray
    kind: str
    outputs: tuple[str, ...]
    inputs: tuple[str, ...]


@dataclass(frozen=True)
class Modes:
    """m modes at s sensors.

    frequency_hz, frequency_sd_hz, damping, damping_sd (m,): undamped natural frequency |lambda| / 2 pi and -Re lambda / |lambda|.
    covariance (2 m, 2 m): of frequency_hz, then damping. shapes (s, m) complex, turned so that real parts are largest;
    shape_sd, imaginary_sd (s, m): of their parts; NaN where unknown. mpc (m,): modal phase collinearity, 1 for a real
    shape. scale (m,): UNIT_MASS or UNIT_LARGEST. stable_orders (m,): in how many orders of `Diagram` the pole was stable.
    lines (m,): spectral lines within the half-power bandwidth, 0 for output-only. error (m,): fitted FRF error near the mode,
    over what is measured there; NaN for output-only.
    """

    frequency_hz: np.ndarray
    frequency_sd_hz: np.ndarray
    damping: np.ndarray
    damping_sd: np.ndarray
    covariance: np.ndarray
    shapes: np.ndarray
    shape_sd: np.ndarray
    imaginary_sd: np.ndarray
    mpc: np.ndarray
    scale: tuple[str, ...]
    stable_orders: np.ndarray
    lines: np.ndarray
    error: np.ndarray

    @property
    def m(self) -> int:
        """Number of modes."""
        return len(self.frequency_hz)


@dataclass(frozen=True)
class Identification(Shown):
    """Modes that a test shows, and what was rejected.

    method: what found them; band_hz; misfit: mean square of fitted errors over stated sd, NaN where none was stated or output-only;
    noise: where the sd of the measured values come from. doubts: why the answer should not be trusted, empty when it can be;
    remarks: what else to know. problem: the deck that the recordings belong to, test: the modes as its test, where there are
    any sensors of it.
    """

    title: str
    sources: tuple[str, ...]
    method: str
    sensors: tuple[str, ...]
    band_hz: tuple[float, float]
    modes: Modes
    diagram: Diagram
    noise: str
    misfit: float = float("nan")
    rejected: tuple[Rejected, ...] = ()
    doubts: tuple[Diagnostic, ...] = ()
    remarks: tuple[Diagnostic, ...] = ()
    fit: FrfFit | None = None
    problem: Problem | None = None
    test: ModalTest | None = None
    details: dict[str, float | int | str] = field(default_factory=dict)

    @property
    def exit_code(self) -> int:
        """0: modes were found and nothing speaks against them; 1: not."""
        return 1 if self.doubts or not self.modes.m else 0


def measured_test(modes: Modes, outputs: Matrix, names: tuple[str, ...]) -> ModalTest:
    """Modes as a test of the model whose degrees of freedom `outputs` reads: (s,) numbers from 0, or weights (s, n).

    Frequencies alone where there is but one sensor: no shape is to be seen.
    """
    number = np.arange(1, modes.m + 1)
    if outputs.shape[0] < 2:
        none = np.zeros((0, modes.m))
        return ModalTest(number, modes.frequency_hz, modes.frequency_sd_hz, np.zeros(0, int), none, none)
    shapes, sd = deck_shapes(modes)
    plain = outputs.ndim == 1
    dofs = np.asarray(outputs if plain else np.abs(dense(outputs)).argmax(axis=1), int)
    return ModalTest(
        number, modes.frequency_hz, modes.frequency_sd_hz, dofs, shapes, sd, "fitted", None if plain else outputs,
        () if plain else names,
    )  # fmt: skip


_LEAST_SD = 0.25  # of the median of a mode: scaling leaves the largest component none of its own


def deck_shapes(modes: Modes) -> tuple[np.ndarray, np.ndarray]:
    """Real shapes (s, m) for a deck, and their sd: of their noise, and of imaginary parts beyond theirs.

    A shape that is scaled by itself has components without errors of their own; none gets less than a share of the median.
    """
    if not modes.m:
        return modes.shapes.real, modes.shape_sd
    beyond = np.maximum((modes.shapes.imag**2 - modes.imaginary_sd**2).mean(axis=0), 0.0)
    sd = np.sqrt(modes.shape_sd**2 + beyond)
    return modes.shapes.real, np.maximum(sd, _LEAST_SD * np.median(sd, axis=0))
