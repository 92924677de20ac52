"""The points of a sweep and what was found at each."""

from collections.abc import Iterator

from mouse_cli.model.campaign import Sweep
from mouse_cli.report.blocks import Block, Column, Table, Text
from mouse_cli.report.section import Options, Section
from mouse_cli.report.sections._wording import LEFT, counted, deck_table


def points(found: Sweep, options: Options) -> Iterator[Block]:
    """One line a point."""
    yield deck_table(found.problem)
    shown = found.parameters[: options.properties]
    columns = (
        Column("point"),
        *(Column(name, literal=True) for name in found.varied),
        Column("ended", align=LEFT),
        Column("chi-square"),
        Column("p"),
        *(Column(each.name, each.unit, literal=True) for each in shown),
    )
    rows = [
        (
            i,
            *(_cell(value) for value in point),
            answer.ended,
            answer.chi2,
            answer.p,
            *(float(v) for v in answer.theta[: len(shown)]),
        )
        for i, (point, answer) in enumerate(zip(found.points, found.answers, strict=True), 1)
    ]
    yield Table(columns, tuple(rows[: options.elements]), 1 + len(found.varied))
    if len(rows) > options.elements:
        yield Text(f"{counted(len(rows) - options.elements, 'further point')}: see --csv.")
    more = len(found.parameters) - len(shown)
    hidden = f"; {counted(more, 'further property', 'further properties')}: see --csv" if more else ""
    yield Text(f"Chi-square and its probability p are those of the residual, after the revision{hidden}.")


def _cell(value: object) -> float | int | str:
    """Words as they are; yes and no for what is either."""
    if isinstance(value, bool):
        return "yes" if value else "no"
    return value


SECTION = Section("sweep-points", 10, "Sweep", points, (Sweep,))
