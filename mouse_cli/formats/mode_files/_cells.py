"""Cells of a table of text as spreadsheets export it: encodings, quotes, decimal commas, thousands, and cells that were lost."""

import csv
import re
from dataclasses import dataclass
from typing import NoReturn

import numpy as np

from mouse_cli.formats.data_files import check_memory, line_span, reject

_MISSING = {"", "-", "--", "---", "nan", "na", "n/a", "n.a.", "#n/a", "#nv", "n/m", "n.m.", "null", "none", "?", "*"}  # fmt: skip
_SPACES = str.maketrans({"\u00a0": " ", "\u2009": " ", "\u202f": " ", "\u2212": "-", "\u2013": "-", "\u2019": "'"})
_GROUPS = re.compile(r"(?<=[0-9])[' ](?=[0-9]{3}(?![0-9]))")
_NUMBER = re.compile(r"[-+]?(?:[0-9][0-9.,]*|[.,][0-9]+)(?:[eEdD][-+]?[0-9]+)?")
_THOUSANDS = r"[1-9][0-9]{0,2}(?:\%s[0-9]{3})+"  # digits in groups of three after a mark
_COMPLEX = re.compile(r"(.*[0-9.,])\s*([-+])\s*(?:([ij])\s*\*?\s*([0-9.,eE+-]+)|([0-9.,eE+-]+?)\s*\*?\s*([ij]))")
_WHOLE = 100  # beside a whole number as large as this one, 1.234 may be 1234


@dataclass
class Rows:
    """Rows of cells with the numbers of their lines, from 1. comma: numbers have decimal commas; mark: what parts the cells."""

    path: str
    lines: list[str]
    cells: list[tuple[int, list[str]]]
    mark: str = ","
    comma: bool = False

    def cell(self, row: int, column: int) -> str:
        """The text of a cell; empty beyond the end of its row."""
        cells = self.cells[row][1]
        return cells[column] if 0 <= column < len(cells) else ""

    def number(self, row: int, column: int) -> float:
        """The number of a cell; NaN where nothing was measured. Raises DeckError (MD252)."""
        word = self.cell(row, column)
        if word.lower() in _MISSING:
            return np.nan
        value = self._plain(word)
        if value is None:
            self.refuse(row, f"'{word[:40]}' is no number", "give numbers, and nothing where none was measured", word)
        if not np.isfinite(value):
            self.refuse(row, f"'{word[:40]}' is not finite", "leave the cell empty where nothing was measured", word)
        return value

    def value(self, row: int, column: int) -> complex:
        """The number of a cell, which may be complex: `0.12+0.03i`. Raises DeckError (MD252)."""
        found = _COMPLEX.fullmatch(self.cell(row, column))
        parts = [self._plain(part or "") for part in (found[1], found[4] or found[5])] if found else [None]
        if None in parts:
            return self.number(row, column)
        return complex(parts[0], -parts[1] if found[2] == "-" else parts[1])

    def _plain(self, word: str) -> float | None:
        """The number that a word without unit is; None for other words."""
        word = word.replace(",", "\0").replace(".", "").replace("\0", ".") if self.comma else word.replace(",", "")
        try:
            return float(_grouped(word).replace("D", "E").replace("d", "e"))
        except ValueError:
            return None

    def refuse(self, row: int, message: str, help: str, part: str = "") -> NoReturn:
        """Raise DeckError (MD252) with the line of a row."""
        line = self.cells[row][0]
        reject("MD252", self.path, message, help, line_span(self.path, line, self.lines[line - 1], part))

    def fitting(self, row: int, head: int) -> None:
        """Refuse a row that has another number of cells than the head: beyond the place where one was lost, all are shifted."""
        needed, own = (len(_ended(self.cells[i][1])) for i in (head, row))
        if len(self.cells[row][1]) < needed or own > needed:
            counts = f"the row has {max(own, 1)} cells and the head {needed}"
            help = "write an empty cell where nothing was measured"
            if own > needed and self.mark == ",":
                help = "where numbers have decimal commas, export the table with semicolons, or write decimal points"
            self.refuse(row, counts, help)


def rows_of(path: str) -> Rows:
    """The rows of a file that are neither empty nor comments. Raises DeckError (MD252)."""
    lines = _text(path).split("\n")
    kept = [(i, line) for i, line in enumerate(lines, 1) if line.strip(" ,;\t") and not line.lstrip().startswith("#")]
    text = "".join(line for _, line in kept)
    mark = ";" if ";" in text else "\t" if "\t" in text else ","
    split = [(i, [cell.strip() for cell in next(csv.reader([line], delimiter=mark, skipinitialspace=True))])
             for i, line in kept]  # fmt: skip
    rows = Rows(path, lines, split, mark)
    rows.comma = _decimal_commas(rows)
    return rows


def missing(word: str) -> bool:
    """Whether a cell says that there is nothing."""
    return word.lower() in _MISSING


def numeric(word: str) -> bool:
    """Whether a cell is a number."""
    return bool(_NUMBER.fullmatch(_grouped(word)))


def _ended(cells: list[str]) -> list[str]:
    """Without empty cells at the end, which trailing separators leave."""
    count = max((k for k, cell in enumerate(cells, 1) if cell), default=0)
    return cells[:count]


def _grouped(word: str) -> str:
    """Without the blanks and apostrophes between thousands: 1'234.5 is 1234.5."""
    return _GROUPS.sub("", word)


def _text(path: str) -> str:
    """The text of a file: UTF-8 or UTF-16, else Windows-1252; blanks, minus signs and ends of lines of all kinds made plain."""
    with open(path, "rb") as stream:
        data = stream.read()
    check_memory(path, 12 * len(data))
    if data[:2] in (b"\xff\xfe", b"\xfe\xff"):
        text = data.decode("utf-16", errors="replace")
    else:
        try:
            text = data.decode("utf-8-sig")
        except UnicodeDecodeError:
            text = data.decode("cp1252", errors="replace")
    return text.replace("\r\n", "\n").replace("\r", "\n").translate(_SPACES)


def _decimal_commas(rows: Rows) -> bool:
    """Whether the numbers of a table have decimal commas, as those tell that can be read in one way only.

    1,234.5 and 0.123 speak for points, 1.234,5 and 0,123 for commas; 1.234 alone may be either. Raises DeckError (MD252).
    """
    points, commas, either, large = [], [], [], False
    for i, (_, cells) in enumerate(rows.cells):
        for word in (_grouped(cell) for cell in cells[1:] if numeric(cell)):
            large = large or (word.lstrip("+-").isdigit() and int(word.lstrip("+-")[:9]) >= _WHOLE)
            kind = _convention(re.split("[eEdD]", word.lstrip("+-"))[0])
            if kind:
                {".": points, ",": commas}.get(kind, either).append((i, word))
    if points and commas:
        (_, first), (row, word) = sorted([points[0], commas[0]])
        help = "write all numbers of the table in one way"
        rows.refuse(row, f"'{word[:40]}' and '{first[:40]}' have other decimal marks", help, word)
    if either and large and not points and not commas:
        row, word = either[0]
        plain, mark = re.sub("[.,]", "", word), "," if "," in word else "."
        message = f"'{word[:40]}' may be {plain[:40]} or have a decimal {'comma' if mark == ',' else 'point'}: no number tells"
        rows.refuse(row, message, "write the numbers without marks of thousands", word)
    return bool(commas) or (not points and any("," in word for _, word in either))


def _convention(word: str) -> str:
    """What the marks of an unsigned number tell: `.` or `,` for its decimals, `?` for either, nothing without marks."""
    used = sorted({mark: word.rfind(mark) for mark in ".," if mark in word}.items(), key=lambda item: item[1])
    if len(used) == 2:
        return used[1][0]
    if not used:
        return ""
    mark, other = used[0][0], "." if used[0][0] == "," else ","
    if re.fullmatch(_THOUSANDS % mark, word):
        return other if word.count(mark) > 1 else "?"
    return mark
