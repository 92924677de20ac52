"""What a deck keeps from every fit, as a reader took it from a file."""

from dataclasses import dataclass, field

import numpy as np

from mouse_cli._span import Span

Additions = dict[int | str, float]


@dataclass
class AlteredDraft:
    """Another configuration: what is added to degrees of freedom or, for masses, nodes, named by number or label."""

    title: str
    where: Span
    masses: Additions
    springs: Additions
    number: np.ndarray
    frequency_hz: np.ndarray
    frequency_sd_hz: np.ndarray


@dataclass
class HoldOutDraft:
    """modes: numbers of modes of the test, sensors: as `dofs` names them; each with its place.

    recordings, frf: titles; segments: a title, and first sample and the one after the last; lines: lowest and highest Hz.
    """

    where: Span
    modes: list[tuple[int, Span]] = field(default_factory=list)
    sensors: list[tuple[str, Span]] = field(default_factory=list)
    altered: list[AlteredDraft] = field(default_factory=list)
    recordings: list[tuple[str, Span]] = field(default_factory=list)
    segments: list[tuple[str, tuple[int, int], Span]] = field(default_factory=list)
    frf: list[tuple[str, Span]] = field(default_factory=list)
    lines: list[tuple[tuple[float, float], Span]] = field(default_factory=list)
