"""Recordings and frequency response functions as a deck gives them, before the model says what their sensors read."""

from dataclasses import dataclass, field

import numpy as np

from mouse_cli._errors import ERROR, WARNING, Diagnostic
from mouse_cli._span import Span
from mouse_cli.formats.sensor import SensorDraft
from mouse_cli.model.block_window import BlockWindow
from mouse_cli.model.frf_test import FORMS, MOST_LINES
from mouse_cli.model.recording import ABSOLUTE, Recording


@dataclass
class Pick:
    """Which channel of a file a sensor is, and what its numbers are; empty texts where that is not said.

    sensitivity: as `100 mV/g`. frame: of an output. where: its place, for messages; None where no deck says it. gain_sd, delay_sd,
    noise_sd: as of a channel.
    """

    sensor: SensorDraft
    role: str
    channel: str
    quantity: str = ""
    unit: str = ""
    sensitivity: str = ""
    where: Span | None = None
    frame: str = ABSOLUTE
    gain_sd: float = 0.0
    delay_sd: float = 0.0
    noise_sd: float = 0.0


@dataclass
class RecordingDraft:
    """A recording, its channels in the order of `sensors`."""

    recording: Recording
    sensors: tuple[SensorDraft, ...]
    where: Span | None = None


@dataclass
class FrfDraft:
    """Functions of one measurement: H, variance (f, o, i), NaN where unknown; coherence (f, o) or None; form, lines as fitted."""

    title: str
    path: str
    kind: str
    frequency_hz: np.ndarray
    H: np.ndarray
    variance: np.ndarray
    outputs: tuple[SensorDraft, ...]
    inputs: tuple[SensorDraft, ...]
    coherence: np.ndarray | None = None
    where: Span | None = None
    form: str = FORMS[0]
    lines: int = MOST_LINES
    decay_rate: float = 0.0
    gain_sd: float = 0.0
    window: BlockWindow | None = None


@dataclass
class Findings:
    """What is wrong with measured data, collected as `Document` of a YAML deck collects it, for data that no deck names."""

    diagnostics: list[Diagnostic] = field(default_factory=list)

    def error(self, code: str, where: Span | None, message: str, help: str = "", note: str = "") -> None:
        """Note an error."""
        self.diagnostics.append(Diagnostic(code, ERROR, message, where, note, help))

    def warn(self, code: str, where: Span | None, message: str, help: str = "", note: str = "") -> None:
        """Note a warning."""
        self.diagnostics.append(Diagnostic(code, WARNING, message, where, note, help))
