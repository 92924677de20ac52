"""Other modes of the posterior: values of the properties that fit as well, and what would decide between them."""

from collections.abc import Iterator

from mouse_cli.model.result import Result
from mouse_cli.report.blocks import Block, Cell, Column, Table, Text
from mouse_cli.report.section import RESULT, Options, Section
from mouse_cli.report.sections._wording import LEFT


def alternatives(result: Result, options: Options) -> Iterator[Block]:
    """A column for each mode of the posterior, the answer first."""
    found = result.alternatives
    if found is None:
        return
    count = 1 + len(found.others)
    yield Text(
        f"The posterior has {count} modes: {count} sets of values that fit these data, each with its own standard deviations. "
        "What holds a property with some confidence is the union of the intervals about them."
    )
    titles = ["answer", *(f"other {i}" for i in range(1, count))]
    columns = [Column("property", align=LEFT), Column("unit", align=LEFT)]
    columns += [Column(each, part) for each in titles for part in ("value", "sd")]
    values = [(result.revised.theta, result.sd_theta), *((each.theta, each.sd) for each in found.others)]
    rows: list[tuple[Cell, ...]] = [
        (parameter.name, parameter.unit, *(float(part[i]) for pair in values for part in pair))
        for i, parameter in enumerate(result.problem.parameters)
    ]
    own = [found.share, *(each.share for each in found.others)]
    rows.append(("share of the posterior", "", *(cell for share in own for cell in (share, None))))
    yield Table(tuple(columns), tuple(rows))
    yield Text(_deciding(result))


def _deciding(result: Result) -> str:
    """The measurement at which the answer and the other that leads differ most."""
    telling = result.alternatives.deciding
    if telling is None:
        return "No shape of the measured modes separates them: measure further modes, or with a known mass added to one side."
    mode, dof, here, there = telling
    label = result.problem.structure.labels[dof]
    return (
        f"To decide, measure the shape of mode {mode} at degree of freedom {label}: the answer predicts {here:.3f} there, the "
        f"other {there:.3f}, of its largest component."
    )


SECTION = Section("alternatives", 105, "Other values that fit as well", alternatives, place=RESULT)
