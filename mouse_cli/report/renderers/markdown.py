"""The report in GitHub's Markdown: tables that render, verbatim lines in fences, special characters escaped."""

import re
from collections.abc import Callable, Iterable, Sequence

from mouse_cli.report.blocks import Block, Cell, Heading, Lines, Matrix, Table, Text, is_blank
from mouse_cli.report.numbers import Numbers
from mouse_cli.report.renderers import Renderer

_SPECIAL = re.compile(r"([\\`*_|<>\[\]])")


def render(blocks: Iterable[Block], numbers: Numbers) -> str:
    """The report as Markdown, its blocks separated by empty lines."""
    return "\n\n".join("\n".join(_RENDER[type(b)](b, numbers)) for b in blocks) + "\n"


def verbatim(text: str) -> str:
    """`text` as code on one line, also in a cell of a table: no markup, and no mention or link, which servers find in plain text.

    >>> verbatim("k1 | `@all`")
    "`k1 \\\\| '@all'`"
    """
    shown = "".join(c if c.isprintable() else "?" for c in text).replace("`", "'").replace("|", "\\|")
    return f"`{shown}`" if shown.strip() else ""


def _heading(block: Heading, numbers: Numbers) -> list[str]:
    return [f"{'#' * (block.level + 1)} {_escaped(block.text)}"]


def _text(block: Text, numbers: Numbers) -> list[str]:
    text = _escaped(block.filled(numbers))
    return [re.sub(r"^(\s*)([#+\-]|\d+[.)])", r"\1\\\2", text)]


def _lines(block: Lines, numbers: Numbers) -> list[str]:
    """A fence longer than any row of backticks in it."""
    longest = max((len(run) for line in block.lines for run in re.findall("`+", line)), default=0)
    fence = "`" * max(3, longest + 1)
    return [f"{fence}text", *(line.rstrip("\r\n") for line in block.lines), fence]


def _table(block: Table, numbers: Numbers) -> list[str]:
    heads = [_escaped(f"{c.name} ({c.unit})" if c.unit else c.name) for c in block.columns]
    left = [c.align == "left" for c in block.columns]
    return _grid(heads, left, ([_cell(c, numbers) for c in row] for row in block.rows))


def _matrix(block: Matrix, numbers: Numbers) -> list[str]:
    unit = f" ({block.unit})" if block.unit else ""
    corner = " \\ ".join(filter(None, block.corner))
    heads = [_escaped(corner), *(_escaped(label) for label in block.column_labels)]
    rows = (
        [_escaped(label), *(_cell(v, numbers) for v in row)]
        for label, row in zip(block.row_labels, block.array.tolist(), strict=True)
    )
    left = [True] + [False] * len(block.column_labels)
    return [f"**{_escaped(block.name + unit)}**", "", *_grid(heads, left, rows)]


def _grid(heads: Sequence[str], left: Sequence[bool], rows: Iterable[Sequence[str]]) -> list[str]:
    rule = [":---" if at_left else "---:" for at_left in left]
    return [f"| {' | '.join(cells)} |" for cells in (heads, rule, *rows)]


def _cell(cell: Cell, numbers: Numbers) -> str:
    if is_blank(cell):
        return ""
    return _escaped(cell) if isinstance(cell, str) else numbers(cell)


def _escaped(text: str) -> str:
    """`text` on one line, with nothing left that Markdown or a table would read as its own."""
    return _SPECIAL.sub(r"\\\1", " ".join(text.split()))


_RENDER: dict[type, Callable[..., list[str]]] = {
    Heading: _heading,
    Text: _text,
    Lines: _lines,
    Table: _table,
    Matrix: _matrix,
}

RENDERER = Renderer("markdown", "modern", render)
