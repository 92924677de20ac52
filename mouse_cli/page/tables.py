"""Tables that sort by a click on their head and copy as TSV; they are plain tables where scripts do not run."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from mouse_cli.page.html import Markup, join, tag
from mouse_cli.page.numbers import shown


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
