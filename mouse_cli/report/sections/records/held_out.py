"""Records that no fit has seen, under the model as it is and with the cause."""

from collections.abc import Iterator

from mouse_cli.model.record_diagnosis import AS_IT_IS, WITH_CAUSE, RecordDiagnosis, RecordScore
from mouse_cli.model.record_update import RecordUpdate
from mouse_cli.report.blocks import Block, Column, Table, Text
from mouse_cli.report.section import Options, Section
from mouse_cli.report.sections._wording import LEFT


def held_out(found: RecordDiagnosis | RecordUpdate, options: Options) -> Iterator[Block]:
    """One line a record and output."""
    if not found.scores:
        return
    columns = (
        Column("record", align=LEFT),
        Column("output", align=LEFT),
        Column("rms measured"),
        Column("short horizon, as it is"),
        Column(found.after),
        Column("whole record, as it is"),
        Column(found.after),
    )
    rows = [
        (one.title, channel, f"{one.signal[i]:.4g}", *_row(one, i))
        for one in found.scores
        for i, channel in enumerate(found.channels)
    ]
    yield Table(columns, tuple(rows)).without_empty_columns()
    yield Text(
        f"rms of measured less simulated. Short horizons are of {found.scores[0].horizon_s:.3g} s, each with the initial state "
        "that fits it best, for both models alike: where trajectories diverge, as under impacts, a whole record judges nothing."
    )


def _row(one: RecordScore, i: int) -> list[str]:
    return [_told(part, name, i) for part in (one.short, one.free) for name in (AS_IT_IS, WITH_CAUSE)]


def _told(errors: dict, name: str, i: int) -> str:
    if name not in errors:
        return ""
    return f"{errors[name][i]:.4g}" if errors[name][i] < float("inf") else "diverges"


SECTION = Section("record-held-out", 80, "Held-out records", held_out, (RecordDiagnosis, RecordUpdate))
