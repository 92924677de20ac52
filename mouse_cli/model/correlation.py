"""What a comparison of a test with its model found; reports read it and compute nothing."""

from dataclasses import dataclass

import numpy as np

from mouse_cli._errors import Diagnostic
from mouse_cli._notebook import Shown
from mouse_cli.model.problem import Problem

REVERSED, SWAPPED, GAIN, STRANGE = "reversed", "swapped", "gain", "strange"  # kinds of sensor faults
ALONE = -1  # in place of a partner: a mode that was not paired


@dataclass(frozen=True)
class SensorFault:
    """kind: one of the words above; sensors: indices (two when swapped); gain: its reading over the model's.

    mac_before, mac_after: mean MAC of the pairs as measured, and with the fault mended (`strange`: the sensor left out).
    """

    kind: str
    sensors: tuple[int, ...]
    gain: float
    mac_before: float
    mac_after: float


@dataclass(frozen=True)
class Orthogonality:
    """Shapes judged with one mass matrix of the size of the test.

    key: `static` or `modal`. test (m, m): measured shapes with each other; sd (m, m): what errors of their components alone make
    of that; cross (m, k): measured with model shapes; model (k, k): model shapes with each other, which shows how well that mass
    matrix stands for the model. All normalised, NaN where a shape misses a component.
    """

    key: str
    title: str
    test: np.ndarray
    sd: np.ndarray
    cross: np.ndarray
    model: np.ndarray


@dataclass(frozen=True)
class Subspace:
    """Close modes, compared as a whole: indices of test and model modes; squared cosines of the principal angles of their spans."""

    test: tuple[int, ...]
    model: tuple[int, ...]
    cosines: np.ndarray


@dataclass(frozen=True)
class Expanded:
    """Measured shapes on all degrees of freedom.

    modes (a,): which measured modes; shapes (n, a): unit modal mass, signs as measured. mass, stiffness (a, a): X'MX
    and X'KX / (omega_i omega_j); hz (a,): Rayleigh quotients. misfit (a,): root mean square of (expanded - measured) / sd.
    """

    key: str
    title: str
    exact: bool
    modes: np.ndarray
    shapes: np.ndarray
    mass: np.ndarray
    stiffness: np.ndarray
    hz: np.ndarray
    misfit: np.ndarray


@dataclass(frozen=True)
class Correlation(Shown):
    """The answer of `correlate`: m measured modes at s sensors against the lowest k modes of the prior model.

    frequencies_hz (k,); visible (k,): length of each model shape at the sensors, over that of the largest. modes (m,): partner of
    each measured mode, from 0, or ALONE; unclaimed: model modes in the band of the test without partner. mac (m, k), auto_test
    (m, m), auto_model (k, k), scale_factor (m,): NaN where no shape was measured. comac, ecomac (s,).
    """

    problem: Problem
    frequencies_hz: np.ndarray
    rigid_modes: int
    visible: np.ndarray
    modes: np.ndarray
    unclaimed: np.ndarray
    mac: np.ndarray
    auto_test: np.ndarray
    auto_model: np.ndarray
    scale_factor: np.ndarray
    sensors: tuple[str, ...]
    comac: np.ndarray
    ecomac: np.ndarray
    faults: tuple[SensorFault, ...]
    orthogonality: tuple[Orthogonality, ...]
    subspaces: tuple[Subspace, ...]
    expanded: Expanded | None
    warnings: tuple[Diagnostic, ...]
