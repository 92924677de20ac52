"""What a careful reader of samples should know, in words."""

from collections.abc import Iterator

from mouse_cli.model.sampled import Sampled
from mouse_cli.report.blocks import Block
from mouse_cli.report.section import RESULT, Options, Section
from mouse_cli.report.sections._wording import remarks as worded


def remarks(found: Sampled, options: Options) -> Iterator[Block]:
    """One paragraph a remark."""
    yield from worded((*found.problem.warnings, *found.warnings), options)


SECTION = Section("sample-remarks", 60, "Remarks", remarks, (Sampled,), place=RESULT)
