"""What each method's answer is not to be trusted for."""

from collections.abc import Iterator

from mouse_cli.model.updated import Compared
from mouse_cli.report.blocks import Block, Text
from mouse_cli.report.section import RESULT, Options, Section


def remarks(found: Compared, options: Options) -> Iterator[Block]:
    """One paragraph a method."""
    for update in found.updates:
        if options.short and not update.warnings:
            continue
        told = "; ".join(f"{remark.code}: {remark.message}" for remark in update.warnings)
        yield Text(f"{update.about.key}: {told or 'no remarks'}.")


SECTION = Section("comparison-remarks", 40, "Remarks", remarks, (Compared,), place=RESULT)
