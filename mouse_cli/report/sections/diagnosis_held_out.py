"""The proof: what either model says of data that no fit has seen."""

from collections.abc import Iterator

import numpy as np

from mouse_cli.model.diagnosis import Diagnosis, Score
from mouse_cli.report.blocks import Block, Column, Table, Text
from mouse_cli.report.section import Options, Section
from mouse_cli.report.sections._wording import LEFT

_COLUMNS = (
    Column("held out", align=LEFT),
    Column("measured", "Hz"),
    Column("model as it is", "Hz"),
    Column("sd", "Hz"),
    Column("difference", "per cent"),
    Column("extended model", "Hz"),
    Column("sd", "Hz"),
    Column("difference", "per cent"),
    Column("MAC as it is"),
    Column("MAC extended"),
)


def held_out(found: Diagnosis, options: Options) -> Iterator[Block]:
    """One line a frequency, then the scores; nothing without such data."""
    held = found.held_out
    if held is None:
        return
    before, alike = _predicted(held.baseline, held.measured_hz)
    nothing = [np.full(len(held.labels), np.nan)] * 3
    after, alike_after = _predicted(held.revised, held.measured_hz) if held.revised else (nothing, nothing[0])
    rows = zip(held.labels, held.measured_hz, *before, *after, alike, alike_after, strict=True)
    yield Table(_COLUMNS, tuple((label, *map(float, row)) for label, *row in rows)).without_empty_columns()
    columns = (
        Column("model", align=LEFT),
        Column("rms frequency error", "per cent"),
        Column("ln predictive density"),
        Column("within 90 % intervals", "per cent"),
    )
    scores = (("as it is", held.baseline), ("extended", held.revised))
    yield Table(columns, tuple(_score(name, score) for name, score in scores if score is not None))
    yield Text(f"How the data were held out: {held.kind}.")


def _predicted(score: Score, measured: np.ndarray) -> tuple[list[np.ndarray], np.ndarray]:
    hz = score.frequencies_hz
    return [hz, score.sd_hz, 100 * (hz / measured - 1)], score.mac


def _score(name: str, score: Score) -> tuple[str, float, float, float]:
    return name, 100 * score.rms_frequency_error, float(score.log_predictive_density), 100 * score.covered


SECTION = Section("diagnosis-held-out", 80, "Data that no fit has seen", held_out, (Diagnosis,))
