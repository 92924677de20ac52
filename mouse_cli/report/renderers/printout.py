"""The printout in the manner of 1972: upper-case headings, tables under them, never more than 132 columns."""

from collections.abc import Callable, Iterable
from textwrap import wrap

from mouse_cli.report.blocks import Block, Heading, Lines, Matrix, Table, Text
from mouse_cli.report.numbers import Numbers
from mouse_cli.report.renderers import Renderer
from mouse_cli.report.renderers._grid import Grid, matrix_grids, table_grids

WIDTH = 132  # columns of the line printer


def render(blocks: Iterable[Block], numbers: Numbers, width: int = WIDTH) -> str:
    """The report as text, every line at most `width` columns, without trailing blanks."""
    lines: list[str] = []
    for block in blocks:
        if lines:
            lines.append("")
        lines += _RENDER[type(block)](block, numbers, width)
    return "\n".join(line.rstrip() for line in lines) + "\n"


def _heading(block: Heading, numbers: Numbers, width: int) -> list[str]:
    text = wrap(printable(block.text).upper(), width)
    return ["*" * width, *text, "*" * width] if block.level == 1 else text


def _text(block: Text, numbers: Numbers, width: int) -> list[str]:
    return wrap(printable(block.filled(numbers)), width)


def stand(block: Lines, numbers: Numbers, width: int) -> list[str]:
    """As they stand; a longer line goes on in the next one, marked by a dot."""
    out: list[str] = []
    for line in block.lines:
        line = printable(line.expandtabs()).rstrip()
        out.append(line[:width])
        out += [". " + line[i : i + width - 2] for i in range(width, len(line), width - 2)]
    return out


def _table(block: Table, numbers: Numbers, width: int) -> list[str]:
    return _grids(table_grids(block, numbers, width))


def _matrix(block: Matrix, numbers: Numbers, width: int) -> list[str]:
    unit = f" ({block.unit})" if block.unit else ""
    name = wrap(printable(f"{block.name}{unit}").upper(), width)
    return [*name, "", *_grids(matrix_grids(block, numbers, width))]


def _grids(grids: Iterable[Grid]) -> list[str]:
    """Parts of a table one below the other, an empty line between them."""
    out: list[str] = []
    for grid in grids:
        if out:
            out.append("")
        out += [printable(line) for line in grid.lines()]
    return out


def printable(text: str) -> str:
    """`text` with one visible character per column: nothing in a deck may move the printer's carriage."""
    return "".join(c if c.isprintable() else " " for c in text)


_RENDER: dict[type, Callable[..., list[str]]] = {
    Heading: _heading,
    Text: _text,
    Lines: stand,
    Table: _table,
    Matrix: _matrix,
}

RENDERER = Renderer("printout", "legacy", render)
