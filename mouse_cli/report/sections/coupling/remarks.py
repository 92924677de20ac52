"""What is to be kept in mind about coupled or modified structures."""

from collections.abc import Iterator

from mouse_cli.model.coupled import Coupled
from mouse_cli.model.modified import Modified
from mouse_cli.report.blocks import Block, Text
from mouse_cli.report.section import Options, Section


def remarks(found: Coupled | Modified, options: Options) -> Iterator[Block]:
    """One paragraph a warning."""
    for each in found.warnings:
        help = f" {each.help[0].upper()}{each.help[1:]}." if each.help else ""
        yield Text(f"{each.code}: {each.message}.{help}".replace("{", "(").replace("}", ")"))


SECTION = Section("coupling-remarks", 90, "Remarks", remarks, (Coupled, Modified))
