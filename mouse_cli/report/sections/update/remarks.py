"""What forbids to trust an updated model, in words."""

from collections.abc import Iterator

from mouse_cli.model.updated import Updated
from mouse_cli.report.blocks import Block, Text
from mouse_cli.report.section import VERDICT, Options, Section
from mouse_cli.report.sections._wording import remarks as worded


def remarks(found: Updated, options: Options) -> Iterator[Block]:
    """One paragraph a remark."""
    if not found.warnings:
        yield Text(_sound(found))
    yield from worded((*found.warnings, *found.problem.warnings), options)


def _sound(found: Updated) -> str:
    """What an answer without remarks is worth."""
    if any(not one.fitted for one in found.configurations):
        return "The model is physical, reproduces the fitted data and predicts the held-out data."
    return "The model is physical and reproduces the fitted data; no data were held out for validation."


SECTION = Section("update-remarks", 60, "Verdict", remarks, (Updated,), place=VERDICT)
