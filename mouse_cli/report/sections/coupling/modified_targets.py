"""What moves a mode to a frequency: masses or springs at places."""

from collections.abc import Iterator
from itertools import groupby

import numpy as np

from mouse_cli.model.coupling import MASS, Target
from mouse_cli.model.modified import Modified, Need
from mouse_cli.report.blocks import Block, Column, Heading, Table, Text
from mouse_cli.report.section import RESULT, Options, Section
from mouse_cli.report.sections._wording import LEFT


def targets(found: Modified, options: Options) -> Iterator[Block]:
    """One table a target; modes are those after the changes."""
    units, confidence = found.modification.problem.units, found.modification.problem.run.confidence
    for target, needs in groupby(found.needs, key=lambda need: need.target):
        yield Heading(f"mode {target.mode} {target.side} {target.hz:g} Hz by a {target.means}", 2)
        yield from _answer(target, list(needs), units.of("kg" if target.means == MASS else "N/m"), confidence)


def _answer(target: Target, needs: list[Need], unit: str, confidence: int) -> Iterator[Block]:
    if len(needs) == 1 and not needs[0].place:
        yield Text(f"{needs[0].reason[0].upper()}{needs[0].reason[1:]}.")
        return
    columns = (
        Column("place", align=LEFT, literal=True), Column(f"{target.means} needed", unit), Column("standard deviation", unit),
        Column(f"for a chance of {confidence} per cent", unit), Column("mode then at", "Hz"),
        Column("limit of the mode there", "Hz"), Column("likeness"),
    )  # fmt: skip
    rows = tuple(
        (
            n.place,
            n.value,
            n.sd if n.sd > 0 else None,
            n.sure if n.sd > 0 else None,
            n.reached_hz,
            n.limit_hz,
            n.likeness,
        )
        for n in needs
    )
    yield Table(columns, rows).without_empty_columns()
    for need in needs:
        if need.reason:
            yield Text(f"MD718: at {need.place} it is impossible: {need.reason}.")
    if any(np.isfinite(need.value) and need.value < 0 for need in needs):
        yield Text("Negative values are to be taken away.")


SECTION = Section("modified-targets", 30, "What it takes", targets, (Modified,), place=RESULT)
