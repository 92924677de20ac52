"""Heading of a comparison: program, deck, what is compared."""

from collections.abc import Iterator

from mouse_cli.model.correlation import ALONE, Correlation
from mouse_cli.report.blocks import Block, Text
from mouse_cli.report.section import Options, Section
from mouse_cli.report.sections._wording import counted, deck_table


def heading(found: Correlation, options: Options) -> Iterator[Block]:
    """What stands on either side."""
    problem = found.problem
    yield deck_table(problem)
    rigid = f", {found.rigid_modes} of them of a rigid body" if found.rigid_modes else ""
    yield Text(
        f"{counted(problem.test.m, 'measured mode')} at {counted(problem.test.s, 'sensor')} against the lowest "
        f"{counted(len(found.frequencies_hz), 'mode')}{rigid} of the model of "
        f"{counted(problem.structure.n, 'degree', 'degrees')} of freedom before any revision. "
        f"Modes are paired by shape and frequency; {int((found.modes != ALONE).sum())} of {problem.test.m} have a partner."
    )


SECTION = Section("correlation-heading", 10, "Deck", heading, (Correlation,))
