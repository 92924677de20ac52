"""Time histories of a test: what excited the structure and what it answered, channel by channel."""

from dataclasses import dataclass, field

import numpy as np

from mouse_cli.model.arrays import freeze
from mouse_cli.model.held_reading import HeldReading

INPUT, OUTPUT = "input", "output"
ABSOLUTE, RELATIVE = FRAMES = ("absolute", "relative")
MOTIONS = {"displacement": 0, "velocity": 1, "acceleration": 2}  # how many times differentiated
ROTATIONS = {"rotation": 0, "angular velocity": 1, "angular acceleration": 2}  # likewise
FORCES = FORCE, MOMENT = ("force", "moment")
QUANTITIES = (*FORCES, *MOTIONS, *ROTATIONS, "sound", "other")


@dataclass(frozen=True)
class Channel:
    """One channel of a recording. role: INPUT or OUTPUT; quantity: one of QUANTITIES; unit: of its samples.

    sensor: what it is mounted on, as decks write a sensor (`12TY`, `3`, `12-TY` for one mounted backwards); empty while no deck
    has said so. weights: what it reads of the model's degrees of freedom, from 0; empty where there is no model. ground: whether
    an input is the motion of the ground that holds the model; its weights then say how the degrees of freedom move along. frame of
    an output: ABSOLUTE, or RELATIVE to that ground. gain_sd: prior sd of ln gain; delay_sd: of the delay of an output, s; 0: known.
    noise_sd: of its white noise, by its rms; 0: as its spectrum shows. held: what it reads besides where supports hold the
    model, 0 in it.
    """

    name: str
    role: str
    quantity: str
    unit: str = ""
    sensor: str = ""
    weights: dict[int, float] = field(default_factory=dict)
    ground: bool = False
    frame: str = ABSOLUTE
    gain_sd: float = 0.0
    delay_sd: float = 0.0
    noise_sd: float = 0.0
    held: tuple[HeldReading, ...] = ()


@dataclass(frozen=True)
class Recording:
    """t samples of c channels, evenly spaced. time_step_s: s; samples (t, c), in the units of the channels.

    title: of the record; path: the file it was read from. start: the first sample's number in that file, from 0, so that findings
    name samples as the file counts them. free: whether no force acts from the first sample on, so that the initial state is all.
    mains_hz, drift_hz: frequency whose multiples, and frequency below which, outputs are not judged; 0: none.
    """

    title: str
    time_step_s: float
    channels: tuple[Channel, ...]
    samples: np.ndarray
    path: str = ""
    start: int = 0
    free: bool = False
    mains_hz: float = 0.0
    drift_hz: float = 0.0

    def __post_init__(self) -> None:
        freeze(self, samples=(len(self.samples), len(self.channels)))

    @property
    def sample_rate_hz(self) -> float:
        """Samples a second."""
        return 1.0 / self.time_step_s

    @property
    def inputs(self) -> np.ndarray:
        """Columns of the excitations (i,), from 0."""
        return self._columns(INPUT)

    @property
    def outputs(self) -> np.ndarray:
        """Columns of the responses (o,), from 0."""
        return self._columns(OUTPUT)

    def _columns(self, role: str) -> np.ndarray:
        return np.array([j for j, channel in enumerate(self.channels) if channel.role == role], dtype=int)
