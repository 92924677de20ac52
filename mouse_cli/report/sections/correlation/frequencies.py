"""Which measured mode is which model mode: frequencies, MAC and scale of the pairs, and the modes without partner."""

from collections.abc import Iterator

import numpy as np

from mouse_cli.model.correlation import ALONE, Correlation
from mouse_cli.report.blocks import Block, Cell, Column, Table, Text
from mouse_cli.report.section import RESULT, Options, Section

_COLUMNS = (
    Column("test mode"),
    Column("model mode"),
    Column("test frequency", "Hz"),
    Column("model frequency", "Hz"),
    Column("difference", "per cent"),
    Column("difference", "test sd"),
    Column("MAC"),
    Column("modal scale factor"),
    Column("seen by the sensors"),
)


def frequencies(found: Correlation, options: Options) -> Iterator[Block]:
    """One line a measured mode, then one for each model mode in the band that none of them is."""
    rows = [_measured(found, i) for i in range(found.problem.test.m)]
    rows += [
        (None, int(j) + 1, None, float(found.frequencies_hz[j]), None, None, None, None, float(found.visible[j]))
        for j in found.unclaimed
    ]
    yield Table(_COLUMNS, tuple(rows)).without_empty_columns()
    yield Text(
        "Differences are model minus test. The modal scale factor brings the measured shape nearest to that of unit modal "
        "mass; seen by the sensors is the length of the model shape at the sensors, over that of the largest."
    )


def _measured(found: Correlation, i: int) -> tuple[Cell, ...]:
    test, j = found.problem.test, int(found.modes[i])
    test_hz, sd = float(test.frequency_hz[i]), float(test.frequency_sd_hz[i])
    if j == ALONE:
        return int(test.number[i]), None, test_hz, None, None, None, None, None, None
    hz = float(found.frequencies_hz[j])
    with np.errstate(invalid="ignore"):
        away = 100 * (hz / test_hz - 1), (hz - test_hz) / sd
    likeness, factor = float(found.mac[i, j]), float(found.scale_factor[i])
    return int(test.number[i]), j + 1, test_hz, hz, *away, likeness, factor, float(found.visible[j])


SECTION = Section("correlation-frequencies", 20, "Pairs of modes", frequencies, (Correlation,), place=RESULT)
