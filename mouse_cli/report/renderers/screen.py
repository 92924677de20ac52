"""The report on one screen: plain headings, compact tables, notes right under them."""

from collections.abc import Iterable
from dataclasses import replace
from textwrap import wrap

from mouse_cli.report.blocks import Block, Heading, Lines, Matrix, Table, Text
from mouse_cli.report.numbers import Numbers
from mouse_cli.report.renderers import Renderer
from mouse_cli.report.renderers._grid import Grid, matrix_grids, table_grids
from mouse_cli.report.renderers._rounding import rounded
from mouse_cli.report.renderers.printout import printable, stand
from mouse_cli.report.section import RESULT

WIDTH, WIDEST = 100, 120  # columns of text, and of tables and lines that are to be copied
_DIGITS = 5  # of numbers in sentences
_WIDE = (Table, Matrix)


def render(blocks: Iterable[Block], numbers: Numbers, width: int = WIDTH) -> str:
    """The report as text, text at most `width` columns wide, without trailing blanks; empty lines before headings alone."""
    lines: list[str] = []
    before: Block | None = None
    for block in blocks:
        if _apart(before, block):
            lines.append("")
        lines += _rendered(block, replace(numbers, digits=_DIGITS), width)
        before = block
    return "\n".join(line.rstrip() for line in lines) + "\n"


def _apart(before: Block | None, block: Block) -> bool:
    """Whether an empty line stands between them: before headings, but not below one, and between tables."""
    if isinstance(block, Heading):
        return before is not None and not isinstance(before, Heading)
    return isinstance(before, _WIDE) and isinstance(block, _WIDE)


def _rendered(block: Block, numbers: Numbers, width: int) -> list[str]:
    match block:
        case Heading():
            return wrap(printable(block.text).upper() if block.level == 1 else printable(block.text), width)
        case Text():
            return wrap(printable(block.filled(numbers)), width, break_on_hyphens=False)
        case Lines():
            return stand(block, numbers, WIDEST)
        case Table():
            short = block if numbers.style == "legacy" else rounded(_units(block))
            return _compact(table_grids(short, numbers, WIDEST))
        case Matrix():
            unit = f" ({block.unit})" if block.unit else ""
            return [*wrap(printable(f"{block.name}{unit}"), width), *_compact(matrix_grids(block, numbers, WIDEST))]


def _units(table: Table) -> Table:
    """Per cent as a sign, which is all that a narrow column has room for."""
    columns = tuple(replace(c, unit="%", digits=c.digits or 3) if c.unit == "per cent" else c for c in table.columns)
    return replace(table, columns=columns)


def _compact(grids: Iterable[Grid]) -> list[str]:
    """Parts of a table one below the other, without empty lines."""
    return [printable(line) for grid in grids for line in grid.lines() if line.strip()]


RENDERER = Renderer("screen", "modern", render, RESULT)
