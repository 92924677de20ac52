"""Properties by samples, beside the normal density of the run."""

from collections.abc import Iterator

from mouse_cli.model.sampled import Sampled
from mouse_cli.report.blocks import Block, Column, Table, Text
from mouse_cli.report.section import RESULT, Options, Section
from mouse_cli.report.sections._wording import LEFT

_COLUMNS = (
    Column("property", align=LEFT),
    Column("unit", align=LEFT),
    Column("run"),
    Column("sd of run"),
    Column("mean"),
    Column("sd"),
    Column("median"),
    Column("68 % from"),
    Column("to"),
    Column("95 % from"),
    Column("to"),
)
_CHAIN = (
    Column("property", align=LEFT),
    Column("autocorrelation time", "steps"),
    Column("effective sample size"),
    Column("R-hat"),
)


def properties(found: Sampled, options: Options) -> Iterator[Block]:
    """One line a property: what the run says, and what the samples say; then how well the chain knows it."""
    rows = []
    for each in found.parameters:
        low, left, median, right, high = (float(value) for value in each.quantiles)
        means = each.normal_mean, each.normal_sd, each.mean, each.sd
        rows.append((each.name, each.unit, *means, median, left, right, low, high))
    yield Table(_COLUMNS, tuple(rows)).without_empty_columns()
    yield Table(_CHAIN, tuple((e.name, round(e.tau, 1), round(e.size), round(e.r_hat, 3)) for e in found.parameters))
    yield Text("Intervals are between quantiles of the samples, with equal shares on either side.")


SECTION = Section("sample-properties", 20, "Properties", properties, (Sampled,), place=RESULT)
