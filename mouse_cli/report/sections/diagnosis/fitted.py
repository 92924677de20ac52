"""The data that were fitted: the model as it is beside the extended one."""

from collections.abc import Iterator

import numpy as np

from mouse_cli.dynamics.frequency import frequency_hz
from mouse_cli.model.diagnosis import NAMED, Diagnosis
from mouse_cli.model.result import Snapshot
from mouse_cli.report.blocks import Block, Cell, Column, Table, Text
from mouse_cli.report.section import Options, Section
from mouse_cli.report.sections._diagnosis_wording import likeness, per_cent, with_cause


def _columns(after: str) -> tuple[Column, ...]:
    return (
        Column("mode"),
        Column("test frequency", "Hz"),
        Column("model as it is", "Hz"),
        Column("difference", "per cent"),
        Column(after, "Hz"),
        Column("difference", "per cent"),
        Column("MAC as it is"),
        Column(f"MAC {after}"),
    )


def fitted(found: Diagnosis, options: Options) -> Iterator[Block]:
    """One line a mode, both models revised by the test."""
    test = found.problem.test.frequency_hz
    nothing = np.full(len(test), np.nan)
    columns = [test, *_against(found.result.revised, test)]
    after = found.extended_result
    columns += _against(after.revised, test) if after else [nothing, nothing, nothing]
    hz, off, alike, hz_after, off_after, alike_after = columns[1:]
    rows = zip(found.problem.test.number, test, hz, off, hz_after, off_after, alike, alike_after, strict=True)
    columns = _columns(with_cause(found))
    yield Table(columns, tuple((int(n), *_told(row)) for n, *row in rows)).without_empty_columns()
    which = "Both models with their" if after else "The model with its"
    yield Text(f"{which} parameters revised by these data; differences are model minus test.")
    if after and after.model_form == "rejected":
        which = with_cause(found) if found.kind == NAMED else f"model {with_cause(found)}"
        yield Text(
            f"At the stated accuracies alone, which `mouse run` takes, the form of the {which} is rejected too: a diagnosis allows "
            "for what theory leaves beside them."
        )


def _told(row: list[float]) -> tuple[Cell, ...]:
    test, hz, off, hz_after, off_after, alike, alike_after = map(float, row)
    return test, hz, per_cent(off), hz_after, per_cent(off_after), likeness(alike), likeness(alike_after)


def _against(model: Snapshot, test: np.ndarray) -> list[np.ndarray]:
    """Frequencies (m,), differences in per cent, MAC."""
    hz = frequency_hz(model.eigenvalues[model.modes])
    return [hz, 100 * (hz / test - 1), model.mac]


SECTION = Section("diagnosis-fitted", 70, "Fitted data, before and after", fitted, (Diagnosis,))
