"""What speaks against identified modes, and what else to know of them."""

from collections.abc import Iterator

from mouse_cli.model.identification import Identification
from mouse_cli.report.blocks import Block
from mouse_cli.report.section import RESULT, Options, Section
from mouse_cli.report.sections._wording import remarks as worded


def remarks(found: Identification, options: Options) -> Iterator[Block]:
    """One paragraph a remark, doubts first."""
    yield from worded((*found.doubts, *found.remarks), options)


SECTION = Section("identification-remarks", 60, "Remarks", remarks, (Identification,), place=RESULT)
