"""What a diagnosis by recordings found, beside what every diagnosis finds."""

from dataclasses import dataclass, field
from typing import ClassVar

import numpy as np

from mouse_cli.model.diagnosis import NOTHING, Diagnosis

AS_IT_IS, WITH_CAUSE = "as it is", "with the cause"


@dataclass(frozen=True)
class LevelSign:
    """The linear model fitted to parts of a record by level: rms of the first output, first resonance in Hz, damping ratio."""

    rms: float
    frequency_hz: float
    damping: float


@dataclass(frozen=True)
class Linearity:
    """Signs of nonlinearity, none of which decides. incoherent: share of the band with coherence below 0.95, nan for several
    forces and for strokes; even, odd: distortion at lines that were not excited, by the excited ones, nan without such an
    excitation; noise likewise. levels: the lowest and the highest third.
    """

    incoherent: float = float("nan")
    even: float = float("nan")
    odd: float = float("nan")
    noise: float = float("nan")
    levels: tuple[LevelSign, ...] = ()


@dataclass(frozen=True)
class RecordScore:
    """Errors of simulations of a record that no fit has seen, rms of each output (s,), in the units of the channels.

    short: over horizons of horizon_s from fitted initial states; free: from the beginning of the record to its end, inf where
    it does not stay finite. signal (s,): rms of the record; noise (s,): that part of `short` that is noise of the channels.
    """

    title: str
    horizon_s: float
    signal: np.ndarray
    short: dict[str, np.ndarray]
    free: dict[str, np.ndarray]
    noise: np.ndarray | None = None


@dataclass(frozen=True)
class Trace:
    """A stretch of an output that no fit has seen, for figures: time in s, measured and simulated; sd of its noise."""

    title: str
    unit: str
    sd: float
    time_s: np.ndarray
    measured: np.ndarray
    simulated: dict[str, np.ndarray]


@dataclass(frozen=True)
class Surface:
    """The force (t,) that the record asks for at the place of a law, its motion x and velocity v, and the fitted law there."""

    title: str
    site: str
    x: np.ndarray
    v: np.ndarray
    force: np.ndarray
    law: np.ndarray


@dataclass(frozen=True)
class Noise:
    """What a model leaves of a record, where it is more than the accuracy of the channels and yet noise. size (s,): rms.

    explained: largest share of it that a force takes which follows from the motion of a place; effective: share of the samples
    that count as independent ones; grows: exponent of its variance over that of the motion, nan for records of one level.
    """

    size: np.ndarray
    explained: float
    effective: float
    grows: float


@dataclass(frozen=True)
class RecordDiagnosis(Diagnosis):
    """The answer of `diagnose` for recordings; `result` is None: there is no modal test.

    channels, sd (s,): outputs and the accuracy taken for them; inputs: names. scores: of held-out records. noise: that which the
    answer rests on, where the accuracy of the channels is not all. fitted: titles of what was fitted. outside: whether what
    `cautions` report is no law of the library, so that none was sought.
    """

    channels: tuple[str, ...] = ()
    units: tuple[str, ...] = ()
    inputs: tuple[str, ...] = ()
    sd: np.ndarray = field(default_factory=lambda: np.zeros(0))
    fitted: tuple[str, ...] = ()
    linearity: Linearity = Linearity()
    scores: tuple[RecordScore, ...] = ()
    noise: Noise | None = None
    trace: Trace | None = None
    surface: Surface | None = None
    outside: bool = False
    after: ClassVar[str] = WITH_CAUSE

    @property
    def exit_code(self) -> int:
        """0: nothing is missing; 1: something is."""
        return 0 if self.kind == NOTHING else 1
