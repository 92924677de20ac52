"""Tables that sort by a click on their head and copy as TSV; they are plain tables where scripts do not run."""

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass

from mouse_cli.page.html import Markup, join, tag
from mouse_cli.page.numbers import apart, probable, shown, signed_per_cent
from mouse_cli.report.reading import Part


@dataclass(frozen=True)
class Cell:
    """A number with the words it is shown in, and a class for its looks; `value` is what is sorted and copied."""

    value: float | None
    words: str
    looks: str = ""


def table(key: str, caption: str, heads: Sequence[str], rows: Iterable[Sequence[object]]) -> Markup:
    """A table of `rows`, each as long as `heads`; the first cell of a row is its head. Empty without rows.

    A cell is a text, a number, None, or a Cell. `key` is the table's own on its page.
    """
    body = [_row(row) for row in rows]
    if not body:
        return Markup("")
    top = tag("tr", *(tag("th", tag("button", head, type="button"), scope="col", aria_sort="none") for head in heads))
    written = tag("table", tag("caption", caption, id=f"{key}-caption"), tag("thead", top), tag("tbody", *body))
    return tag("div", written, class_="table", role="region", tabindex=0, aria_labelledby=f"{key}-caption")


def _row(cells: Sequence[object]) -> Markup:
    first, *rest = cells
    return tag("tr", _cell(first, "th", scope="row"), join(_cell(cell, "td") for cell in rest))


def _cell(cell: object, name: str, **attributes: object) -> Markup:
    if isinstance(cell, str):
        return tag(name, cell, **attributes)
    if not isinstance(cell, Cell):
        cell = Cell(cell, shown(cell))
    value = "" if cell.value is None else f"{cell.value:.12g}"
    return tag(name, cell.words, data_value=value, class_=f"number {cell.looks}".strip(), **attributes)


@dataclass(frozen=True)
class Column:
    """A head, and what its cells show of a part: the value below `key`, or what a function makes of the part.

    looks: "text"; "name", a text or a number that stands for one; "percent", a difference with its sign; "share", in per cent;
    "p", a probability; else the digits of a number. against: the key of the value that `key` is compared with, in per cent.
    """

    head: str
    key: str | Callable[[Part], object]
    looks: str | int = 5
    against: str = ""

    def cell(self, part: Part) -> object:
        """A text, a Cell or None."""
        if callable(self.key):
            return self.key(part)
        if self.looks == "text":
            return part.text(self.key)
        if self.looks == "name":
            label = part.label(self.key)
            return label if isinstance(part.values.get(self.key), str) else Cell(part.number(self.key), label or "–")
        value = part.number(self.key)
        if self.against:
            value = apart(value, part.number(self.against))
        if self.looks == "share":
            value = None if value is None else 100 * value
            return Cell(value, "–" if value is None else f"{shown(value, 3)} %")
        words = {"percent": signed_per_cent, "p": probable}.get(self.looks) or (lambda x: shown(x, self.looks))
        return Cell(value, words(value))


def columns_of(spec: str, *functions: Callable[[Part], object]) -> tuple[Column, ...]:
    """Columns "head: key looks against | ...", the last two where they are not the usual; "head: ()" takes the next function.

    >>> [(c.head, c.key, c.looks) for c in columns_of("test, Hz: test_hz | MAC: mac 4")]
    [('test, Hz', 'test_hz', 5), ('MAC', 'mac', 4)]
    """
    found, given = [], iter(functions)
    for head, _, how in (each.partition(": ") for each in spec.split(" | ")):
        key, looks, against = (how.split() + ["5", ""][len(how.split()) - 1 :])[:3]
        of = next(given) if key == "()" else key
        found.append(Column(head, of, int(looks) if looks.isdigit() else looks, against))
    return tuple(found)


@dataclass(frozen=True)
class Listing:
    """A table with a line for each of `parts`; the HTML page and Markdown show the same."""

    key: str
    caption: str
    columns: Sequence[Column]
    parts: Sequence[Part]

    def __bool__(self) -> bool:
        return bool(self.parts)

    @property
    def heads(self) -> tuple[str, ...]:
        return tuple(column.head for column in self.columns)

    def rows(self) -> Iterator[tuple[object, ...]]:
        return (tuple(column.cell(part) for column in self.columns) for part in self.parts)

    def html(self) -> Markup:
        return table(self.key, self.caption, self.heads, self.rows())
