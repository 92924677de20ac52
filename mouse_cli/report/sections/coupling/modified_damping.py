"""Damping of the modified model."""

from collections.abc import Iterator

from mouse_cli.model.modified import Modified
from mouse_cli.report.blocks import Block
from mouse_cli.report.section import Options, Section
from mouse_cli.report.sections.run.forecast_damping import damping


def modified(found: Modified, options: Options) -> Iterator[Block]:
    """One line a complex mode after the changes."""
    yield from damping(found.after, options)


SECTION = Section("modified-damping", 60, "Damping after the changes", modified, (Modified,))
