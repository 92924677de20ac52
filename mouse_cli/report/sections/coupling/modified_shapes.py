"""Mode shapes of the modified model."""

from collections.abc import Iterator

from mouse_cli.model.modified import Modified
from mouse_cli.report.blocks import Block
from mouse_cli.report.section import Options, Section
from mouse_cli.report.sections.run.forecast_shapes import shapes


def modified(found: Modified, options: Options) -> Iterator[Block]:
    """Shapes after the changes and their standard deviations."""
    yield from shapes(found.after, options)


SECTION = Section("modified-shapes", 70, "Mode shapes after the changes", modified, (Modified,))
