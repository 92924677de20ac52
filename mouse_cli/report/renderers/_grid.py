"""Tables and matrices as columns of text of one width each, split into parts that fit the page."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from textwrap import wrap

from mouse_cli.report.blocks import Column, Matrix, Table, is_blank
from mouse_cli.report.numbers import Numbers

GAP = 2
_ACROSS = 10  # columns of a matrix side by side, as many as a card or a page of 1972 had
_NARROWEST = 12  # a column of words is folded no narrower than this


@dataclass(frozen=True)
class Strip:
    """One column: `head` lines above `cells`, a cell being one or more lines; `left`: cells start at the left edge."""

    head: tuple[str, ...]
    cells: tuple[tuple[str, ...], ...]
    left: bool

    @property
    def width(self) -> int:
        """Columns of the page that it takes."""
        return max((len(line) for lines in (self.head, *self.cells) for line in lines), default=0)

    def folded(self, width: int) -> "Strip":
        """The same strip with its words wrapped at `width`."""
        head = tuple(part for line in self.head for part in wrap(line, width) or [""])
        cells = tuple(tuple(p for line in cell for p in wrap(line, width) or [""]) for cell in self.cells)
        return Strip(head, cells, self.left)


@dataclass(frozen=True)
class Grid:
    """Strips side by side, `gap` columns between them."""

    strips: tuple[Strip, ...]
    gap: int = GAP

    def lines(self) -> Iterator[str]:
        """The lines of the page."""
        depth = max(len(s.head) for s in self.strips)
        yield from self._row([("",) * (depth - len(s.head)) + s.head for s in self.strips])
        if depth and self.strips[0].cells:
            yield ""
        for cells in zip(*(s.cells for s in self.strips), strict=True):
            yield from self._row(cells)

    def _row(self, cells: Iterable[tuple[str, ...]]) -> Iterator[str]:
        """One row, as many lines as its tallest cell."""
        cells = list(cells)
        for i in range(max(len(c) for c in cells)):
            pairs = zip(cells, self.strips, strict=True)
            line = (" " * self.gap).join(_placed(c[i] if i < len(c) else "", s) for c, s in pairs)
            yield line.rstrip()


def _placed(text: str, strip: Strip) -> str:
    return text.ljust(strip.width) if strip.left else text.rjust(strip.width)


def table_grids(table: Table, numbers: Numbers, width: int) -> Iterator[Grid]:
    """`table` in one part, or in as many as `width` asks for, its key columns in front of each."""
    strips = [_strip(column, [row[j] for row in table.rows], numbers) for j, column in enumerate(table.columns)]
    keys, rest = _fitted(strips[: table.keys], width // 2), strips[table.keys :]
    room = width - _total(keys)
    rest = _folded_words(rest, room)
    yield from (Grid((*keys, *part)) for part in _parts(rest, room, len(rest) or 1))


def matrix_grids(matrix: Matrix, numbers: Numbers, width: int) -> Iterator[Grid]:
    """`matrix` in pages of up to 10 columns, its row labels in front of each."""
    first = _fitted([_labels(matrix)], width // 3)
    below = ("",) if matrix.corner[1] else ()
    strips = [
        Strip((label, *below), tuple((numbers(v),) for v in matrix.array[:, j].tolist()), False)
        for j, label in enumerate(matrix.column_labels)
    ]
    strips = [s.folded(width // 3) if s.width > width // 3 else s for s in strips]
    gap = GAP if _total([*first, *strips[:_ACROSS]]) - GAP <= width else 1
    room = width - _total(first, gap)
    yield from (Grid((*first, *part), gap) for part in _parts(strips, room, _ACROSS, gap))


def _labels(matrix: Matrix) -> Strip:
    """Row labels; in their head what the columns are, beside the columns' labels, and below it what the rows are."""
    rows, columns = (name.upper() for name in matrix.corner)
    widest = max(len(text) for text in (rows, columns, *matrix.row_labels, ""))
    head = (columns.rjust(widest), rows) if columns else (rows,)
    return Strip(head, tuple((label,) for label in matrix.row_labels), True)


def _strip(column: Column, cells: list, numbers: Numbers) -> Strip:
    """A table's column: its name folded to the width of its cells where words allow, its unit below."""
    texts = tuple(("",) if is_blank(c) else (c if isinstance(c, str) else numbers(c),) for c in cells)
    name = column.name if column.literal else column.name.upper()
    widest = max((len(t[0]) for t in texts), default=0)
    longest_word = max((len(word) for word in name.split()), default=1)
    head = tuple(wrap(name, max(widest, longest_word, 1)))
    unit = (f"({column.unit})",) if column.unit else ()
    return Strip(head + unit, texts, column.align == "left")


def _total(strips: Iterable[Strip], gap: int = GAP) -> int:
    """Columns that `strips` take, with the gap after each."""
    return sum(s.width + gap for s in strips)


def _fitted(strips: list[Strip], room: int) -> list[Strip]:
    """`strips` folded, all alike, until they take no more than `room`."""
    if _total(strips) <= room:
        return strips
    each = max(1, room // len(strips) - GAP)
    return [s.folded(each) if s.width > each else s for s in strips]


def _folded_words(strips: list[Strip], room: int) -> list[Strip]:
    """`strips` with the widest column of words folded to what the others leave of `room`; none wider than `room`."""
    words = [i for i, s in enumerate(strips) if s.left]
    over = _total(strips) - GAP - room
    if over > 0 and words:
        widest = max(words, key=lambda i: strips[i].width)
        strips[widest] = strips[widest].folded(max(_NARROWEST, strips[widest].width - over))
    return [s.folded(room) if s.width > room else s for s in strips]


def _parts(strips: list[Strip], room: int, most: int, gap: int = GAP) -> Iterator[list[Strip]]:
    """`strips` in order, in parts of at most `most` that take at most `room`."""
    part: list[Strip] = []
    for strip in strips:
        if part and (len(part) == most or _total([*part, strip], gap) - gap > room):
            yield part
            part = []
        part.append(strip)
    if part or not strips:
        yield part
