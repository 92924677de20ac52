"""What a careful reader of a diagnosis of arrangements should know."""

from collections.abc import Iterator

from mouse_cli.model.arrangements import ArrangementsDiagnosis
from mouse_cli.report.blocks import Block, Text
from mouse_cli.report.section import RESULT, Options, Section
from mouse_cli.report.sections._wording import remarks as worded


def remarks(found: ArrangementsDiagnosis, options: Options) -> Iterator[Block]:
    """One paragraph each."""
    for text in found.remarks:
        yield Text(f"{text[:1].upper()}{text[1:]}.")
    yield from worded((remark for each in found.problems for remark in each.warnings), options)


SECTION = Section("arrangements-remarks", 90, "Remarks", remarks, (ArrangementsDiagnosis,), place=RESULT)
