"""What a careful reader of a diagnosis by recordings should know."""

from collections.abc import Iterator

from mouse_cli.model.record_diagnosis import RecordDiagnosis
from mouse_cli.model.record_update import RecordUpdate
from mouse_cli.report.blocks import Block, Text
from mouse_cli.report.section import RESULT, Options, Section
from mouse_cli.report.sections._wording import remarks as worded


def remarks(found: RecordDiagnosis | RecordUpdate, options: Options) -> Iterator[Block]:
    """One paragraph each."""
    for text in found.remarks:
        yield Text(f"{text[:1].upper()}{text[1:]}.")
    for each in getattr(found, "untried", ()):
        yield Text(f"Not considered: {each.physics} ({each.reason}).")
    yield from worded(found.problem.warnings, options)


SECTION = Section("record-remarks", 90, "Remarks", remarks, (RecordDiagnosis, RecordUpdate), place=RESULT)
