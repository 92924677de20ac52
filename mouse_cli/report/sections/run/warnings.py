"""What a careful reader of a run should know: warnings of the deck and of the update."""

from collections.abc import Iterator

from mouse_cli.model.result import Result
from mouse_cli.report.blocks import Block
from mouse_cli.report.section import RESULT, Options, Section
from mouse_cli.report.sections._wording import remarks


def warnings(result: Result, options: Options) -> Iterator[Block]:
    """One paragraph each."""
    yield from remarks((*result.problem.warnings, *result.warnings), options)


SECTION = Section("warnings", 130, "Warnings", warnings, place=RESULT)
