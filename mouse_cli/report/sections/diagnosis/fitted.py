"""The data that were fitted: the model as it is beside the extended one."""

from collections.abc import Iterator

import numpy as np

from mouse_cli.dynamics.frequency import frequency_hz
from mouse_cli.model.diagnosis import NAMED, Diagnosis
from mouse_cli.model.modal_test import ModalTest
from mouse_cli.model.result import Result
from mouse_cli.report.blocks import Block, Cell, Column, Table, Text
from mouse_cli.report.section import RESULT, Options, Section
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
    test, after = found.problem.test, found.extended_result
    hz, off, alike = _against(found.result, test)
    hz_after, off_after, alike_after = _against(after, test) if after else np.full((3, test.m), np.nan)
    rows = zip(test.number, test.frequency_hz, hz, off, hz_after, off_after, alike, alike_after, strict=True)
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


def _against(result: Result, test: ModalTest) -> np.ndarray:
    """Frequencies, differences in per cent, MAC (3, m); NaN of modes that are related to none of the model, which no fit holds."""
    model, kept = result.revised, np.isin(test.number, result.problem.test.number)
    hz = frequency_hz(model.eigenvalues[model.modes])
    found = np.full((3, test.m), np.nan)
    found[:, kept] = hz, 100 * (hz / test.frequency_hz[kept] - 1), model.mac
    return found


SECTION = Section("diagnosis-fitted", 70, "Fitted data, before and after", fitted, (Diagnosis,), place=RESULT)
