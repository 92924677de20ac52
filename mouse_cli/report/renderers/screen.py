"""The report on one screen: plain headings, compact tables, notes right under them."""

from collections.abc import Iterable, Sequence
from dataclasses import replace
from math import floor, isfinite, log10
from textwrap import wrap

from mouse_cli.report.blocks import Block, Cell, Column, Heading, Lines, Matrix, Table, Text
from mouse_cli.report.numbers import Numbers
from mouse_cli.report.renderers import Renderer
from mouse_cli.report.renderers._grid import Grid, matrix_grids, table_grids
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


_USUAL, _EACH = 5, 4  # digits of columns that do not say how many; of cells that have no decimals in common
_LARGE, _SMALL = 1e7, 1e-4  # beyond them numbers have an exponent


def rounded(table: Table) -> Table:
    """`table` with its real numbers as text, as short as its columns ask for."""
    if not table.rows:
        return table
    columns = [
        _column(column, cells) for column, cells in zip(table.columns, zip(*table.rows, strict=True), strict=True)
    ]
    return replace(table, rows=tuple(zip(*columns, strict=True)))


def _column(column: Column, cells: Sequence[Cell]) -> list[Cell]:
    digits = column.digits or _USUAL
    sizes = [abs(cell) for cell in cells if isinstance(cell, float) and isfinite(cell) and cell != 0]
    places = _places(sizes, digits)
    if column.unit == "%" and places is None:
        places = _most(sizes, digits)
    each = min(digits, _EACH)
    return [_written(cell, each, places) if isinstance(cell, float) and isfinite(cell) else cell for cell in cells]


def _places(sizes: Sequence[float], digits: int) -> int | None:
    """Decimals for all of them; None where the largest and the smallest have none in common that shows both.

    >>> _places([226.81, 537.43], 5), _places([2e11, 7800.0], 4), _places([], 5)
    (2, None, 0)
    """
    if not sizes:
        return 0
    largest, smallest = max(sizes), min(sizes)
    if not _SMALL <= largest < _LARGE:
        return None
    places = _decimals(largest, digits)
    return places if smallest >= 0.5 * 10.0**-places else None


def _most(sizes: Sequence[float], digits: int) -> int | None:
    """Decimals that show half of the errors at least: the others are none beside the largest; None where they are more."""
    if not _SMALL <= max(sizes) < _LARGE:
        return None
    places = _decimals(max(sizes), digits)
    return places if 2 * sum(size >= 0.5 * 10.0**-places for size in sizes) >= len(sizes) else None


def _decimals(largest: float, digits: int) -> int:
    return max(0, digits - 1 - floor(log10(largest)))


def _written(value: float, digits: int, places: int | None) -> str:
    """`value` with `places` decimals, or else with so many digits.

    >>> _written(-0.00001, 3, 1), _written(7.2e10, 4, None), _written(1346.76, 4, None)
    ('0.0', '7.200e+10', '1347')
    """
    if places is not None:
        return f"{value:.{places}f}" if round(value, places) else f"{0:.{places}f}"
    if value and not _SMALL <= abs(value) < _LARGE:
        return f"{value:.{digits - 1}e}"
    size = floor(log10(abs(value))) if value else 0
    return f"{value:.{max(0, digits - 1 - size)}f}"
