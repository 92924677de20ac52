"""The revised properties: what the test made of them and how well they are known now."""

from collections.abc import Iterator

from mouse_cli.model.result import Result
from mouse_cli.report.blocks import Block, Cell, Column, Table, Text
from mouse_cli.report.section import Options, Section
from mouse_cli.report.sections._wording import LEFT


def properties(result: Result, options: Options) -> Iterator[Block]:
    """One line a property."""
    if not result.status.answered:
        yield Text("The run gave no answer; the properties stand unrevised.")
        return
    columns = (
        Column("property", align=LEFT),
        Column("unit", align=LEFT),
        Column("prior"),
        Column("revised"),
        Column("change"),
        Column("change", "per cent"),
        Column("sd before"),
        Column("sd after"),
        Column("interval from"),
        Column("interval to"),
        Column("limit", align=LEFT),
    )
    rows = tuple(_row(result, i) for i in range(len(result.problem.parameters)))
    yield Table(columns, rows).without_empty_columns()
    yield Text(f"The interval holds the property with {result.problem.run.confidence} per cent confidence.")
    if result.at_limit.any():
        yield Text("A property at its limit has no standard deviation: the limit, and not the test, decides it.")


def _row(result: Result, i: int) -> tuple[Cell, ...]:
    """Line of property i."""
    parameter, before, after = result.problem.parameters[i], result.prior.theta[i], result.revised.theta[i]
    free = not result.at_limit[i]
    low, high = result.interval(i) if free else (None, None)
    return (
        parameter.name,
        parameter.unit,
        float(before),
        float(after),
        float(after - before),
        float(100 * (after - before) / abs(before)) if before else None,
        float(result.problem.prior.sd[i]),
        float(result.sd_theta[i]) if free else None,
        low,
        high,
        None if free else "at limit",
    )


SECTION = Section("properties", 100, "Revised properties", properties)
