"""The revised properties: what the test made of them and how well they are known now."""

from collections.abc import Iterator

import numpy as np

from mouse_cli.model.result import Result
from mouse_cli.report.blocks import Block, Cell, Column, Table, Text
from mouse_cli.report.section import RESULT, Options, Section
from mouse_cli.report.sections._wording import LEFT


def properties(result: Result, options: Options) -> Iterator[Block]:
    """One line a property; of a short report those that moved most, by their standard deviations, where not all have room."""
    if not result.status.answered:
        yield Text("The run gave no answer; the properties stand unrevised.")
        return
    confidence = result.problem.run.confidence
    columns = (
        Column("property", align=LEFT),
        Column("unit", align=LEFT),
        Column("before" if options.short else "prior"),
        Column("after" if options.short else "revised"),
        *(() if options.short else (Column("change"),)),
        Column("change", "per cent"),
        Column("sd before", digits=3),
        Column("sd after", digits=3),
        Column(f"{confidence} % from" if options.short else "interval from"),
        Column("to" if options.short else "interval to"),
        Column("limit", align=LEFT),
    )
    order = np.arange(len(result.problem.parameters))
    if options.short and len(order) > options.rows:
        order = np.argsort(-np.abs(_moved(result)), kind="stable")
    rows = tuple(_row(result, int(i), options.short) for i in order)
    yield Table(columns, rows, rest="that moved less").without_empty_columns()
    if not options.short:
        yield Text(f"The interval holds the property with {confidence} per cent confidence.")
    if result.at_limit.any():
        yield Text("A property at its limit has no standard deviation: the limit, and not the test, decides it.")


def _moved(result: Result) -> np.ndarray:
    """Changes (p,) in prior standard deviations, 0 of properties that are held."""
    sd = result.problem.prior.sd
    change = result.revised.theta - result.prior.theta
    return np.divide(change, sd, out=np.zeros_like(sd), where=sd > 0)


def _row(result: Result, i: int, short: bool) -> tuple[Cell, ...]:
    """Line of property i."""
    parameter, before, after = result.problem.parameters[i], result.prior.theta[i], result.revised.theta[i]
    free = not result.at_limit[i]
    low, high = result.interval(i) if free else (None, None)
    return (
        parameter.name,
        parameter.unit,
        float(before),
        float(after),
        *(() if short else (float(after - before),)),
        float(100 * (after - before) / abs(before)) if before else None,
        float(result.problem.prior.sd[i]),
        float(result.sd_theta[i]) if free else None,
        low,
        high,
        None if free else "at limit",
    )


SECTION = Section("properties", 100, "Revised properties", properties, place=RESULT)
