"""The proof: what either model says of data that no fit has seen."""

from collections.abc import Iterator

import numpy as np

from mouse_cli.model.diagnosis import BY_DECK, BY_MODE, Diagnosis, Score
from mouse_cli.report.blocks import Block, Cell, Column, Table, Text
from mouse_cli.report.section import Options, Section
from mouse_cli.report.sections._diagnosis_wording import likeness, per_cent, predicting
from mouse_cli.report.sections._wording import LEFT

_HOW = {
    BY_DECK: "The deck holds these data out: no fit has seen them, and no candidate was chosen by them.",
    BY_MODE: "The deck holds nothing out. Each mode in turn was left out, both models fitted to the others, and it was predicted; "
    "the mechanism was chosen with all of them, so that this proves less than data which the deck holds out.",
}


def _columns(after: str) -> tuple[Column, ...]:
    return (
        Column("held out", align=LEFT),
        Column("measured", "Hz"),
        Column("model as it is", "Hz"),
        Column("sd", "Hz"),
        Column("difference", "per cent"),
        Column(after, "Hz"),
        Column("sd", "Hz"),
        Column("difference", "per cent"),
        Column("MAC as it is"),
        Column(f"MAC {after}"),
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
    columns = _columns(predicting(found))
    yield Table(columns, tuple((label, *_told(row)) for label, *row in rows)).without_empty_columns()
    columns = (
        Column("model", align=LEFT),
        Column("rms frequency error", "per cent"),
        Column("log predictive density"),
        Column("within 90 % intervals", "per cent"),
    )
    scores = (("as it is", held.baseline), (predicting(found), held.revised))
    yield Table(columns, tuple(_score(name, score) for name, score in scores if score is not None))
    yield Text(f"{_HOW[held.kind]} Each sd is that of the difference, by model and measurement.")


def _predicted(score: Score, measured: np.ndarray) -> tuple[list[np.ndarray], np.ndarray]:
    hz = score.frequencies_hz
    return [hz, score.sd_hz, 100 * (hz / measured - 1)], score.mac


def _told(row: list[float]) -> tuple[Cell, ...]:
    measured, hz, sd, off, hz_after, sd_after, off_after, alike, alike_after = map(float, row)
    before, after = (hz, _fine(sd), per_cent(off)), (hz_after, _fine(sd_after), per_cent(off_after))
    return measured, *before, *after, likeness(alike), likeness(alike_after)


def _fine(sd: float) -> str:
    return "" if sd != sd else f"{sd:.2g}"


def _score(name: str, score: Score) -> tuple[str, str, str, str]:
    covered = "" if score.covered != score.covered else f"{100 * score.covered:.0f}"
    return name, per_cent(100 * score.rms_frequency_error), f"{score.log_predictive_density:.1f}", covered


SECTION = Section("diagnosis-held-out", 80, "Held-out data, before and after", held_out, (Diagnosis,))
