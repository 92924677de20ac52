"""What a test engineer should look at before the model is revised."""

from collections.abc import Iterator

from mouse_cli.model.correlation import Correlation
from mouse_cli.report.blocks import Block, Text
from mouse_cli.report.section import Options, Section


def remarks(found: Correlation, options: Options) -> Iterator[Block]:
    """One paragraph a remark."""
    for remark in (*found.problem.warnings, *found.warnings):
        advice = f" {remark.help[0].upper()}{remark.help[1:]}." if remark.help else ""
        yield Text(f"{remark.code}: {remark.message}.{advice}")


SECTION = Section("correlation-remarks", 70, "Remarks", remarks, (Correlation,))
