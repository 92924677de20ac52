"""Arrangements that no fit has seen: each frequency before the first cause and after the last."""

from collections.abc import Iterator

from mouse_cli.model.arrangements import ArrangementsDiagnosis
from mouse_cli.model.diagnosis import Score
from mouse_cli.report.blocks import Block, Cell, Column, Table
from mouse_cli.report.section import Options, Section
from mouse_cli.report.sections._diagnosis_wording import per_cent
from mouse_cli.report.sections._wording import LEFT

_SCORES = (
    Column("model", align=LEFT),
    Column("rms frequency error", "per cent"),
    Column("log predictive density"),
    Column("within 90 % intervals", "per cent"),
)
_ROWS = (
    Column("frequency", align=LEFT),
    Column("test", "Hz"),
    Column("as it is", "Hz"),
    Column("error", "per cent"),
    Column("with all mechanisms", "Hz"),
    Column("sd", "Hz"),
    Column("error", "per cent"),
)


def held_out(found: ArrangementsDiagnosis, options: Options) -> Iterator[Block]:
    """Scores turn by turn, then one line a frequency; nothing without such data."""
    held = found.held_out
    if held is None:
        return
    after = held.revised
    scores = [("as it is", held.baseline)]
    scores += [(f"with {turn.best.title}", turn.held) for turn in found.turns if turn.held is not None]
    scores += [] if after is None else [("with all mechanisms, fitted together", after)]
    yield Table(_SCORES, tuple(_score(name, score) for name, score in scores))
    off = 100 * (held.baseline.frequencies_hz / held.measured_hz - 1)
    columns = [held.measured_hz, held.baseline.frequencies_hz, map(per_cent, off)]
    if after is not None:
        left = 100 * (after.frequencies_hz / held.measured_hz - 1)
        columns += [after.frequencies_hz, (f"{sd:.2g}" for sd in after.sd_hz), map(per_cent, left)]
    yield Table(_ROWS[: len(columns) + 1], tuple(zip(held.labels, *columns, strict=True)))


def _score(name: str, score: Score) -> tuple[Cell, ...]:
    return (
        name,
        per_cent(100 * score.rms_frequency_error),
        f"{score.log_predictive_density:.1f}",
        f"{100 * score.covered:.0f}",
    )


SECTION = Section(
    "arrangements-held-out", 80, "Configurations held out, before and after", held_out, (ArrangementsDiagnosis,)
)
