"""What a careful reader should know: warnings of the deck and of the update, remarks of the diagnosis."""

from collections.abc import Iterator

from mouse_cli.model.diagnosis import Diagnosis
from mouse_cli.report.blocks import Block, Text
from mouse_cli.report.section import RESULT, Options, Section
from mouse_cli.report.sections._wording import remarks as worded


def remarks(found: Diagnosis, options: Options) -> Iterator[Block]:
    """One paragraph each."""
    for text in found.remarks:
        yield Text(text if text.endswith(".") else f"{text}.")
    yield from worded((*found.problem.warnings, *found.result.warnings), options)


SECTION = Section("diagnosis-remarks", 90, "Remarks", remarks, (Diagnosis,), place=RESULT)
