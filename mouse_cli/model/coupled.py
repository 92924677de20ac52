"""What `mouse couple` answers: functions of the whole with their accuracy, natural frequencies, and what reductions make of
them."""

from dataclasses import dataclass

import numpy as np

from mouse_cli._errors import Diagnostic
from mouse_cli._notebook import Shown
from mouse_cli.model.coupling import Coupling
from mouse_cli.model.frf_test import FrfTest


@dataclass(frozen=True)
class InterfaceState:
    """The interface at f lines: condition number of its scaled flexibility, singular values used, and its noise: the standard
    deviation of the flexibility by its size, NaN where unknown, 0 for models. conditions: their number c. error: of functions
    in bases."""

    condition: np.ndarray
    kept: np.ndarray
    noise: np.ndarray
    conditions: int
    error: float = 0.0


@dataclass(frozen=True)
class Peak:
    """A peak of one function: where, how high with its sd (NaN where unknown), and its phase, degrees."""

    response: str
    force: str
    hz: float
    magnitude: float
    sd: float
    phase: float


@dataclass(frozen=True)
class ReducedModes:
    """One reduction with `keep` modes of each part: coordinates of the whole, its lowest frequencies (k,) in Hz, and what is
    off, relative."""

    method: str
    keep: int
    coordinates: int
    frequencies_hz: np.ndarray
    error: np.ndarray


@dataclass(frozen=True)
class CoupledModes:
    """Natural frequencies (k,) of the whole, rigid-body modes first, and reductions beside them; size: degrees of freedom."""

    frequencies_hz: np.ndarray
    rigid: int
    size: int
    reduced: tuple[ReducedModes, ...] = ()


@dataclass(frozen=True)
class Coupled(Shown):
    """The answer. functions: of the whole, in the kind asked for, or None, and their peaks; interface: at its lines; modes:
    None where a part has none."""

    coupling: Coupling
    functions: FrfTest | None
    interface: InterfaceState | None
    modes: CoupledModes | None
    peaks: tuple[Peak, ...] = ()
    warnings: tuple[Diagnostic, ...] = ()
