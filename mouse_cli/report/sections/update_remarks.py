"""What forbids to trust an updated model, in words."""

from collections.abc import Iterator

from mouse_cli.model.updated import Updated
from mouse_cli.report.blocks import Block, Text
from mouse_cli.report.section import Options, Section


def remarks(found: Updated, options: Options) -> Iterator[Block]:
    """One paragraph a remark."""
    for remark in (*found.problem.warnings, *found.warnings):
        advice = f" {remark.help[0].upper()}{remark.help[1:]}." if remark.help else ""
        yield Text(f"{remark.code}: {remark.message}.{advice}")
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
