"""The interface of coupled structures: condition numbers line by line, what noise makes of them, what was truncated."""

from collections.abc import Iterator

import numpy as np

from mouse_cli.model.coupled import Coupled, InterfaceState
from mouse_cli.report.blocks import Block, Column, Table, Text
from mouse_cli.report.section import Options, Section
from mouse_cli.report.sections._wording import counted

_SHOWN = 12  # lines in the table


def interface(found: Coupled, options: Options) -> Iterator[Block]:
    """Overall, then at some lines, the worst among them."""
    state = found.interface
    if state is None or not state.conditions:
        return
    hz, worst = found.functions.frequency_hz, int(np.argmax(state.condition))
    yield Text(
        f"{counted(state.conditions, 'condition')} at {counted(len(hz), 'line')}. The condition number of their flexibility, "
        f"scaled so "
        "that units do not count, has the median {} and is largest at {} Hz: {}.",
        (float(np.median(state.condition)), float(hz[worst]), float(state.condition[worst])),
    )
    yield _lines(found, state, worst)
    if (state.noise > 0).any():
        lost = np.count_nonzero(state.condition * state.noise > 1)
        yield Text(
            "Condition number times noise bounds the relative error of the forces at the interface: "
            f"it is above 1 at {counted(lost, 'line')} of {len(hz)}."
        )
    elif np.isnan(state.noise).any():
        yield Text(
            "The accuracy of measured functions is not known: give `sd`, or functions with their coherence and averages."
        )
    if state.error > 0:
        yield Text(
            "Functions of large models are computed in bases; those checked are off by at most {}, relative.",
            (state.error,),
        )


def _lines(found: Coupled, state: InterfaceState, worst: int) -> Table:
    hz = found.functions.frequency_hz
    shown = np.unique(np.append(np.linspace(0, len(hz) - 1, min(_SHOWN, len(hz))).astype(int), worst))
    columns = (
        Column("frequency", "Hz"), Column("condition number"), Column("noise", "per cent"), Column("condition number times noise"),
        Column("singular values kept"),
    )  # fmt: skip
    truncated = (state.kept < state.conditions).any()
    rows = []
    for k in shown:
        noise = float(state.noise[k]) if state.noise[k] > 0 else np.nan
        kept = int(state.kept[k]) if truncated else None
        rows.append((float(hz[k]), float(state.condition[k]), 100 * noise, float(state.condition[k]) * noise, kept))
    return Table(columns, tuple(rows)).without_empty_columns()


SECTION = Section("coupling-interface", 20, "The interface", interface, (Coupled,))
