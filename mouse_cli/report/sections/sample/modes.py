"""Modes of the posterior density, where it has several."""

from collections.abc import Iterator

from mouse_cli.model.sampled import Sampled
from mouse_cli.report.blocks import Block, Column, Table, Text
from mouse_cli.report.section import RESULT, Options, Section


def modes(found: Sampled, options: Options) -> Iterator[Block]:
    """One line a mode, the highest first; nothing where there is one."""
    if len(found.modes) < 2:
        return
    own = tuple(Column(p.name, p.unit, literal=True) for p in found.result.problem.parameters)
    columns = (Column("mode"), *own, Column("J"), Column("share"))
    rows = tuple(
        (i, *(float(value) for value in each.theta[: len(own)]), each.cost, each.share)
        for i, each in enumerate(found.modes, 1)
    )
    yield Table(columns, rows)
    yield Text(
        "J is chi-square of the data with that of the prior; the share is that of the samples nearest to the mode."
    )


SECTION = Section("sample-modes", 40, "Modes of the posterior", modes, (Sampled,), place=RESULT)
