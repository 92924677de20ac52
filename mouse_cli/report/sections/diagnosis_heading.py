"""What was diagnosed: program, deck, model and test."""

from collections.abc import Iterator

from mouse_cli.model.diagnosis import Diagnosis
from mouse_cli.report.blocks import Block, Text
from mouse_cli.report.section import Options, Section
from mouse_cli.report.sections._wording import counted, deck_table
from mouse_cli.report.sections.held_out import told


def heading(found: Diagnosis, options: Options) -> Iterator[Block]:
    """Program and deck, then the size of both."""
    problem = found.problem
    yield deck_table(problem)
    held = f" Held out: {told(problem.hold_out)}." if problem.hold_out else ""
    yield Text(
        f"{counted(problem.test.m, 'measured mode')} at {counted(problem.test.s, 'sensor')}; a model of "
        f"{counted(problem.structure.n, 'degree', 'degrees')} of freedom with "
        f"{counted(len(problem.parameters), 'parameter')}, which were revised beside each candidate.{held}"
    )


SECTION = Section("diagnosis-heading", 20, "Deck", heading, (Diagnosis,))
