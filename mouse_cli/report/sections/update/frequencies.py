"""Frequencies by the updated model: those fitted, those held out, and those of the changed structure."""

from collections.abc import Iterator

from mouse_cli.model.updated import Predicted, Updated
from mouse_cli.report.blocks import Block, Column, Heading, Table, Text
from mouse_cli.report.section import RESULT, Options, Section

_ROUNDING = 1e-6  # per cent
_COLUMNS = (
    Column("mode"),
    Column("test frequency", "Hz"),
    Column("prior model", "Hz"),
    Column("difference", "per cent"),
    Column("updated model", "Hz"),
    Column("difference", "per cent"),
    Column("MAC"),
)


def frequencies(found: Updated, options: Options) -> Iterator[Block]:
    """A table for each configuration."""
    for one in found.configurations:
        yield Heading(
            f"{'Fitted modes' if one.fitted else one.title}, {'used' if one.fitted else 'not used'} by the method", 2
        )
        rows = tuple(_row(one, i) for i in range(len(one.number)))
        yield Table(_COLUMNS, rows).without_empty_columns()
        if one.rms_percent == one.rms_percent:
            yield Text("Root mean square difference of the updated model: {} per cent.", (cleared(one.rms_percent),))


def _row(one: Predicted, i: int) -> tuple:
    test, prior, revised = (float(values[i]) for values in (one.test_hz, one.prior_hz, one.revised_hz))
    off = [cleared(100 * (hz / test - 1)) for hz in (prior, revised)]
    return int(one.number[i]), test, prior, off[0], revised, off[1], float(one.mac[i])


def cleared(percent: float) -> float:
    """A difference in per cent, 0 where it is rounding."""
    return 0.0 if abs(percent) < _ROUNDING else percent


SECTION = Section(
    "update-frequencies", 30, "Test against model, before and after", frequencies, (Updated,), place=RESULT
)
