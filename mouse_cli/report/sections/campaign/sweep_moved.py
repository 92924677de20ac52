"""What moves over a sweep, by how much, and by which quantity."""

from collections.abc import Iterator

import numpy as np

from mouse_cli.model.campaign import Moved, Sweep
from mouse_cli.report.blocks import Block, Column, Table, Text
from mouse_cli.report.section import RESULT, Options, Section
from mouse_cli.report.sections._wording import LEFT


def moved(found: Sweep, options: Options) -> Iterator[Block]:
    """One line a property, then one a frequency."""
    head = (Column("from"), Column("to"), Column("moves by", "sd", digits=4), Column("most by", align=LEFT))
    shares = tuple(Column(f"share of {name}", literal=True, digits=3) for name in found.varied)
    if found.parameters:
        first = (Column("property", align=LEFT), Column("unit", align=LEFT))
        rows = tuple((each.name, each.unit, *_row(each, found.varied)) for each in found.parameters[: options.elements])
        yield Table((*first, *head, *shares), rows).without_empty_columns()
    if found.frequencies:
        rows = tuple((int(each.name), *_row(each, found.varied)) for each in found.frequencies)
        columns = (Column("mode"), Column("from", "Hz"), Column("to", "Hz"), *head[2:], *shares)
        yield Table(columns, rows).without_empty_columns()
    yield Text(
        "Lengths are in posterior standard deviations, the median of those found. A share is that of the variance over the points "
        "which a quantity explains by itself; the rest is due to interactions."
    )


def _row(each: Moved, varied: tuple[str, ...]) -> tuple:
    shares = np.nan_to_num(np.array(each.shares))
    most = varied[int(shares.argmax())] if len(shares) and shares.max() > 0 else ""
    return (
        each.low,
        each.high,
        round(each.lengths, 3) if np.isfinite(each.lengths) else None,
        most,
        *(round(s, 3) for s in each.shares),
    )


SECTION = Section("sweep-moved", 20, "What moves", moved, (Sweep,), place=RESULT)
