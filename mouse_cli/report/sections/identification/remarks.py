"""What speaks against identified modes, and what else to know of them."""

from collections.abc import Iterator

from mouse_cli.model.identification import Identification
from mouse_cli.report.blocks import Block, Text
from mouse_cli.report.section import Options, Section


def remarks(found: Identification, options: Options) -> Iterator[Block]:
    """One paragraph a remark, doubts first."""
    for remark in (*found.doubts, *found.remarks):
        advice = f" {remark.help[0].upper()}{remark.help[1:]}." if remark.help else ""
        yield Text(f"{remark.code}: {remark.message}.{advice}".replace("{", "{{").replace("}", "}}"))


SECTION = Section("identification-remarks", 60, "Remarks", remarks, (Identification,))
