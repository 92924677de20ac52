"""What forbids to trust an updated model, in words."""

from collections.abc import Iterator

from mouse_cli.model.updated import Updated
from mouse_cli.report.blocks import Block, Text
from mouse_cli.report.section import Options, Section
from mouse_cli.report.sections._wording import remarks as worded


def remarks(found: Updated, options: Options) -> Iterator[Block]:
    """One paragraph a remark."""
    yield from worded((*found.problem.warnings, *found.warnings))
    if not found.warnings:
        yield Text(_sound(found))


def _sound(found: Updated) -> str:
    """What an answer without remarks is worth."""
    if any(not one.fitted for one in found.configurations):
        return (
            "Nothing speaks against this model: it is physical, reproduces what was fitted, and foresees what was not."
        )
    return "Nothing speaks against this model, which is physical and reproduces what was fitted; nothing was held out as a proof."


SECTION = Section("update-remarks", 60, "Remarks", remarks, (Updated,))
