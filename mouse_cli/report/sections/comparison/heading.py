"""Heading of a comparison of methods: program, deck, and which methods there are."""

from collections.abc import Iterator

from mouse_cli.model.updated import Compared
from mouse_cli.report.blocks import Block, Column, Table, Text
from mouse_cli.report.section import Options, Section
from mouse_cli.report.sections._wording import LEFT, counted, deck_table


def heading(found: Compared, options: Options) -> Iterator[Block]:
    """The methods, and why others had no answer."""
    yield deck_table(found.problem)
    test = found.problem.test
    if test is not None:
        yield Text(
            f"Each method was given {counted(test.m, 'measured mode')} at {counted(test.s, 'sensor')}, and predicts the held-out "
            "data."
        )
    columns = (
        Column("method", align=LEFT),
        Column("name", align=LEFT),
        Column("iterations"),
        Column("settled", align=LEFT),
    )
    rows = [(u.about.key, u.about.title, u.iterations, "yes" if u.converged else "no") for u in found.updates]
    yield Table(columns, tuple(rows))
    for key, why in found.refused.items():
        yield Text(f"{key} has no answer: {why[0].code}: {why[0].message}.")


SECTION = Section("comparison-heading", 10, "Methods", heading, (Compared,))
