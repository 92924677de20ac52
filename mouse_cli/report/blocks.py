"""What a report is made of, whatever it will look like: headings, texts, tables, matrices and verbatim lines."""

from collections.abc import Iterable
from dataclasses import dataclass, field, replace
from itertools import chain
from typing import Any

import numpy as np

Cell = int | float | str | None


@dataclass(frozen=True)
class Heading:
    """Title of a section (level 1) or of a part of one (level 2)."""

    text: str
    level: int = 1


@dataclass(frozen=True)
class Text:
    """One paragraph; each `{}` in it is filled by the next of `values`, printed as all numbers of the report are."""

    text: str
    values: tuple[float, ...] = ()

    def filled(self, number: Any) -> str:
        """The paragraph with its values written by `number`."""
        return self.text.format(*(number(v) for v in self.values)) if self.values else self.text


@dataclass(frozen=True)
class Column:
    """Head of a table's column; `literal`: the name is someone's own (a property's) and keeps its letters.

    digits: those that count, where a form shortens numbers; 0: as it shortens most.
    """

    name: str
    unit: str = ""
    align: str = "right"
    literal: bool = False
    digits: int = 0


def heads(*columns: str | Column) -> tuple[Column, ...]:
    """Columns by the row of their heads: units in brackets, `<` before what starts at the left, as words do.

    >>> heads("<site | error [Hz]", Column("MAC", digits=4))[:2] == (Column("site", align="left"), Column("error", "Hz"))
    True
    """
    each = ([one] if isinstance(one, Column) else map(_head, one.split(" | ")) for one in columns)
    return tuple(chain.from_iterable(each))


def _head(text: str) -> Column:
    name, _, unit = text.removeprefix("<").removesuffix("]").partition(" [")
    return Column(name, unit, "left" if text.startswith("<") else "right")


@dataclass(frozen=True)
class Table:
    """Rows of cells under columns. A table too wide for its page is printed in parts that repeat the first `keys` columns.

    Rows may be given as any iterables, and numbers as those of numpy; they are held as tuples of Python's.
    kept: so many rows count, the others are folded in a short report, 0: all count; rest: what the others are.
    """

    columns: tuple[Column, ...]
    rows: Iterable[Iterable[Cell]]
    keys: int = 1
    kept: int = 0
    rest: str = ""

    def __post_init__(self) -> None:
        rows = tuple(tuple(cell.item() if isinstance(cell, np.generic) else cell for cell in row) for row in self.rows)
        object.__setattr__(self, "rows", rows)
        for row in rows:
            if len(row) != len(self.columns):
                raise ValueError(f"a row has {len(row)} cells for {len(self.columns)} columns")

    def without_empty_columns(self) -> "Table":
        """The same table without the columns that hold nothing in any row; the first `keys` columns stay."""
        kept = [j for j in range(len(self.columns)) if j < self.keys or any(not is_blank(row[j]) for row in self.rows)]
        rows = tuple(tuple(row[j] for j in kept) for row in self.rows)
        return replace(self, columns=tuple(self.columns[j] for j in kept), rows=rows)


@dataclass(frozen=True)
class Matrix:
    """Array (rows, columns) with a name, a unit and labels; NaN is printed as a blank.

    corner: what the labels are, e.g. `position` for the rows and `mode` for the columns.
    """

    name: str
    array: np.ndarray
    row_labels: tuple[str, ...]
    column_labels: tuple[str, ...]
    unit: str = ""
    corner: tuple[str, str] = ("", "")

    def __post_init__(self) -> None:
        expected = (len(self.row_labels), len(self.column_labels))
        if self.array.shape != expected:
            raise ValueError(f"{self.name} has shape {self.array.shape}, its labels {expected}")


@dataclass(frozen=True)
class Lines:
    """Lines that are printed as they stand, such as the cards of a deck."""

    lines: tuple[str, ...] = field(default_factory=tuple)


Block = Heading | Text | Table | Matrix | Lines


def is_blank(cell: Cell) -> bool:
    """Whether a cell shows nothing: None, an empty text, NaN."""
    return cell is None or cell == "" or (isinstance(cell, float) and cell != cell)
