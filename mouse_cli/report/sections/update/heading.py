"""Heading of an update by one method: program, deck, method, how it ended."""

from collections.abc import Iterator

from mouse_cli.model.updated import Updated
from mouse_cli.report.blocks import Block, Text
from mouse_cli.report.section import Options, Section
from mouse_cli.report.sections._wording import counted, deck_table


def heading(found: Updated, options: Options) -> Iterator[Block]:
    """What was done, by which equation."""
    about, test = found.about, found.problem.test
    yield deck_table(found.problem)
    yield Text(f"Method: {about.title} ({about.source}).")
    yield Text(f"    {about.equation}.")
    if test is not None:
        used = f"{counted(test.m, 'measured mode')} at {counted(test.s, 'sensor')}"
        how = (
            f", expanded to {found.problem.structure.n} degrees of freedom by {found.expansion}"
            if found.expansion
            else ""
        )
        yield Text(f"Used: {used}{how}.")
    if found.iterations > 1:
        ended = "settled" if found.converged else "not settled"
        yield Text(
            f"{found.iterations} iterations, {ended}; the last one changed the answer by {{}} of itself.",
            (found.change,),
        )


SECTION = Section("update-heading", 10, "Updating by one method", heading, (Updated,))
