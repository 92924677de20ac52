"""Natural frequencies of the revised model by samples, and what a new measurement would give."""

from collections.abc import Iterator

from mouse_cli.model.sampled import Sampled
from mouse_cli.report.blocks import Block, Column, Table, Text
from mouse_cli.report.section import RESULT, Options, Section

_COLUMNS = (
    Column("mode"),
    Column("test", "Hz"),
    Column("run", "Hz"),
    Column("sd of run", "Hz"),
    Column("mean", "Hz"),
    Column("sd", "Hz"),
    Column("95 % from", "Hz"),
    Column("to", "Hz"),
    Column("new test from", "Hz"),
    Column("to", "Hz"),
)


def frequencies(found: Sampled, options: Options) -> Iterator[Block]:
    """One line a measured mode."""
    rows = []
    for each in found.frequencies:
        low, high = float(each.quantiles[0]), float(each.quantiles[-1])
        new = (None, None) if each.predicted is None else tuple(float(value) for value in each.predicted)
        rows.append(
            (int(each.name), each.measured, each.normal_mean, each.normal_sd, each.mean, each.sd, low, high, *new)
        )
    if rows:
        yield Table(_COLUMNS, tuple(rows)).without_empty_columns()
        yield Text(
            "The 95 % interval is of the model's own frequency; a new measurement of the same accuracy lies within the last two "
            "columns with probability 0.95."
        )


SECTION = Section("sample-frequencies", 30, "Natural frequencies", frequencies, (Sampled,), place=RESULT)
