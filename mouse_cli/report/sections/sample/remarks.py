"""What a careful reader of samples should know, in words."""

from collections.abc import Iterator

from mouse_cli.model.sampled import Sampled
from mouse_cli.report.blocks import Block, Text
from mouse_cli.report.section import Options, Section
from mouse_cli.report.sections._wording import remarks as worded


def remarks(found: Sampled, options: Options) -> Iterator[Block]:
    """One paragraph a remark."""
    if found.result.rejected:
        yield Text("The form of the model is rejected: the posterior is that of a model which cannot give these data.")
    yield from worded((*found.problem.warnings, *found.warnings))


SECTION = Section("sample-remarks", 60, "Remarks", remarks, (Sampled,))
