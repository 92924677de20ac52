"""What of the test took no part in the revision, and what the revised model says of it."""

from collections.abc import Iterator

import numpy as np

from mouse_cli.dynamics.correlation import mac, pair
from mouse_cli.dynamics.frequency import frequency_hz
from mouse_cli.model.hold_out import HoldOut
from mouse_cli.model.modal_test import ModalTest
from mouse_cli.model.result import Result
from mouse_cli.report.blocks import Block, Column, Table, Text
from mouse_cli.report.section import RESULT, Options, Section
from mouse_cli.report.sections._wording import counted

_COLUMNS = (
    Column("held-out mode"),
    Column("test frequency", "Hz"),
    Column("revised model", "Hz"),
    Column("difference", "per cent"),
    Column("MAC"),
)


def held_out(result: Result, options: Options) -> Iterator[Block]:
    """What it is, and the modes beside those of the revised model; nothing where all data were used."""
    held = result.problem.hold_out
    if held is None:
        return
    yield Text(f"Held out, and used by no fit: {told(held)}. `mouse diagnose` reports the predictive error.")
    if held.test is not None and result.status.answered:
        rows = _predicted(result, held.test)
        if rows:
            yield Table(_COLUMNS, rows).without_empty_columns()


def told(held: HoldOut) -> str:
    """What is held out, in words."""
    parts = []
    if len(held.modes):
        numbers = ", ".join(str(number) for number in held.whole.number[held.modes])
        parts.append(f"{'mode' if len(held.modes) == 1 else 'modes'} {numbers}")
    if len(held.sensors):
        parts.append(f"{counted(len(held.sensors), 'sensor')} of {held.whole.s}")
    parts += [
        f"{counted(len(one.number), 'frequency', 'frequencies')} of the configuration '{one.title}'"
        for one in held.altered
    ]
    return "; ".join(parts)


def _predicted(result: Result, test: ModalTest) -> tuple[tuple[int | float, ...], ...]:
    """One line for each held-out mode that is among the modes computed, none of which is a fitted one."""
    model = result.revised
    free = np.setdiff1d(np.arange(len(model.eigenvalues)), model.modes)
    hz, seen = frequency_hz(np.maximum(model.eigenvalues, 0.0)), test.read(model.shapes)
    if result.problem.run.pairing == "mac" and test.s and len(free) >= test.m:
        modes = free[pair(test.shapes, test.frequency_hz, seen[:, free], hz[free])]
    else:
        modes = test.number - 1
    rows = []
    for i, j in enumerate(modes.tolist()):
        if j < len(hz):
            alike = float(mac(test.shapes[:, [i]], seen[:, [j]])[0, 0]) if test.s else float("nan")
            off = 100 * (hz[j] / test.frequency_hz[i] - 1)
            rows.append((int(test.number[i]), float(test.frequency_hz[i]), float(hz[j]), float(off), alike))
    return tuple(rows)


SECTION = Section("held-out", 117, "Data held out", held_out, place=RESULT)
