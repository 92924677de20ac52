"""What is to be kept in mind about coupled or modified structures."""

from collections.abc import Iterator

from mouse_cli.model.coupled import Coupled
from mouse_cli.model.modified import Modified
from mouse_cli.report.blocks import Block
from mouse_cli.report.section import RESULT, Options, Section
from mouse_cli.report.sections._wording import remarks as worded


def remarks(found: Coupled | Modified, options: Options) -> Iterator[Block]:
    """One paragraph a warning."""
    yield from worded(found.warnings, options)


SECTION = Section("coupling-remarks", 90, "Remarks", remarks, (Coupled, Modified), place=RESULT)
