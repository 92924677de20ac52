"""What a test engineer should look at before the model is revised."""

from collections.abc import Iterator

from mouse_cli.model.correlation import Correlation
from mouse_cli.report.blocks import Block
from mouse_cli.report.section import RESULT, Options, Section
from mouse_cli.report.sections._wording import remarks as worded


def remarks(found: Correlation, options: Options) -> Iterator[Block]:
    """One paragraph a remark."""
    yield from worded((*found.warnings, *found.problem.warnings), options)


SECTION = Section("correlation-remarks", 70, "Remarks", remarks, (Correlation,), place=RESULT)
