"""Test against model before and after: one line a mode, the table to look at first."""

from collections.abc import Iterator

import numpy as np

from mouse_cli.dynamics.frequency import frequency_hz
from mouse_cli.model.result import Result, Snapshot
from mouse_cli.report.blocks import Block, Column, Table, Text
from mouse_cli.report.section import RESULT, Options, Section

_COLUMNS = (
    Column("mode"),
    Column("test frequency", "Hz"),
    Column("prior frequency", "Hz"),
    Column("difference", "per cent"),
    Column("revised frequency", "Hz"),
    Column("difference", "per cent"),
    Column("prior MAC", digits=4),
    Column("revised MAC", digits=4),
)
_SHORT = (
    Column("mode"),
    Column("measured", "Hz"),
    Column("before", "Hz"),
    Column("error", "per cent"),
    Column("after", "Hz"),
    Column("error", "per cent"),
    Column("MAC before", digits=4),
    Column("MAC after", digits=4),
)


def before_after(result: Result, options: Options) -> Iterator[Block]:
    """Frequencies and MAC of both models beside the test, and the root mean square of the differences."""
    test = result.problem.test.frequency_hz
    if not len(test):
        return
    before, after = _hz(result.prior), _hz(result.revised)
    off_before, off_after = 100 * (before / test - 1), 100 * (after / test - 1)
    columns = (test, before, off_before, after, off_after, result.prior.mac, result.revised.mac)
    rows = tuple(
        (int(number), *(float(column[i]) for column in columns)) for i, number in enumerate(result.problem.test.number)
    )
    yield Table(_SHORT if options.short else _COLUMNS, rows).without_empty_columns()
    if np.isfinite(test).any() and options.short:
        rms = [f"{_root_mean_square(off):.3g} %" for off in (off_before, off_after)]
        yield Text(f"Errors are model minus test; rms {rms[0]} before, {rms[1]} after.")
    elif np.isfinite(test).any():
        yield Text(
            "Differences are model minus test; their root mean square is {} per cent before and {} per cent after.",
            (_root_mean_square(off_before), _root_mean_square(off_after)),
        )


def _hz(model: Snapshot) -> np.ndarray:
    """Natural frequencies (m,) of the modes that were paired with the measured ones."""
    return frequency_hz(model.eigenvalues[model.modes])


def _root_mean_square(values: np.ndarray) -> float:
    return float(np.sqrt(np.nanmean(values**2)))


SECTION = Section("before-after", 115, "Test against model, before and after", before_after, place=RESULT)
