"""Tables as text (.csv, .txt, .tsv, .dat, .asc): one line for each sample or line of frequency, one column for each channel.

Columns are separated by semicolons, tabulators, commas or blanks; before the numbers stand any lines, of which the last with as
many cells as there are columns names them, `acc3`, `acc3 (g)`, `acc3 [m/s2]`; a line of units may follow. Complex numbers are
written `0.1+0.2j`. Beside semicolons and tabulators, a comma in a number is a decimal comma.
"""

import re
from itertools import islice

import numpy as np

from mouse_cli.formats.data_files import line_span, text_lines
from mouse_cli.formats.recording_files import MOST_COLUMNS, Column, Contents, RecordingFormat, reject
from mouse_cli.model.channel_units import unit

_MOST_HEAD = 200  # lines before the numbers
_MISSING = ("", "nan", "na", "n/a", "null", "-", "--", "#n/a", "inf", "-inf", "+inf")
_DECIMAL_COMMA = re.compile(r"[-+]?[0-9]*,[0-9]+([eE][-+]?[0-9]+)?")
_COMMENTS = "#%!"


def _read(path: str) -> Contents:
    with open(path, encoding="utf-8-sig", errors="replace", newline=None) as stream:
        head = [line.rstrip("\n") for line in islice(stream, _MOST_HEAD)]
    first, separator = _first(path, head)
    width = _columns(head[first : first + 5], separator)
    values = _at_once(path, first, separator, head[first])
    if values is None or values.shape[1] != width:
        values = _slowly(path, first, separator, width)
    names, units = _head(head[:first], separator, width)
    return Contents(tuple(Column(names[j], values[:, j], units[j]) for j in range(width)))


def _first(path: str, lines: list[str]) -> tuple[int, str | None]:
    """The line of the first numbers, from 0, and what separates them."""
    for i, line in enumerate(lines[:_MOST_HEAD]):
        if not line.strip() or line.lstrip()[0] in _COMMENTS:
            continue
        separator = next((mark for mark in (";", "\t", ",") if mark in line), None)
        cells = _cells(line, separator)
        if len(cells) > MOST_COLUMNS:
            reject("MD258", path, f"line {i + 1} has more than {MOST_COLUMNS} cells", "divide the table")
        comma = separator in (";", "\t")
        if any(_number(cell, comma) is not None for cell in cells) and all(
            _number(cell, comma) is not None or cell.lower() in _MISSING for cell in cells
        ):
            return i, separator
    reject(
        "MD601",
        path,
        f"none of the first {min(len(lines), _MOST_HEAD)} lines is a row of numbers",
        "give a table of numbers",
    )


def _columns(lines: list[str], separator: str | None) -> int:
    """How many there are: a separator that ends every line begins none."""
    rows = [_cells(line, separator) for line in lines if line.strip()]
    return len(rows[0]) - (len(rows[0]) > 1 and all(not row[-1] for row in rows))


def _cells(line: str, separator: str | None) -> list[str]:
    """The cells of a line, the last of which holds the rest of one that has far too many."""
    return [cell.strip().strip('"').strip() for cell in line.split(separator, MOST_COLUMNS + 1)]


def _number(cell: str, comma: bool) -> complex | None:
    """The number that a cell spells; NaN is none."""
    try:
        value = complex(_spelled(cell, comma))
    except ValueError:
        return None
    return None if value != value else value


def _spelled(text: str, comma: bool) -> str:
    text = text.replace(",", ".") if comma else text
    return text.replace("i", "j").replace(" ", "").replace("jnf", "inf") if "i" in text or " " in text else text


def _at_once(path: str, first: int, separator: str | None, line: str) -> np.ndarray | None:
    """The table (k, c) as numpy reads it, decimal commas included; None where a cell is no plain number."""
    kind = complex if "j" in line else float
    try:
        if not _has_decimal_commas(line, separator):
            return np.loadtxt(path, kind, None, separator, skiprows=first, ndmin=2, encoding="latin-1")
        with open(path, encoding="latin-1") as stream:
            return np.loadtxt((row.replace(",", ".") for row in stream), kind, None, separator, skiprows=first, ndmin=2)
    except ValueError:
        return None


def _has_decimal_commas(line: str, separator: str | None) -> bool:
    return separator in (";", "\t") and any(_DECIMAL_COMMA.fullmatch(cell) for cell in _cells(line, separator))


def _slowly(path: str, first: int, separator: str | None, width: int) -> np.ndarray:
    """The table cell by cell: NaN for a cell that is empty or says so, decimal commas, i for j; refuses what is no number."""
    lines = text_lines(path, "utf-8-sig", "replace")
    comma = _has_decimal_commas(lines[first], separator)
    rows = []
    last = max(i for i, line in enumerate(lines) if line.strip())
    for i in range(first, last + 1):
        line = lines[i]
        if not line.strip() or line.lstrip()[0] in _COMMENTS:
            continue
        cells = _cells(line, separator)
        cells = cells[:width] if not any(cells[width:]) else cells
        if len(cells) != width:
            message = f"the line has {len(cells)} values; the first row of numbers, line {first + 1}, has {width}"
            reject("MD252", path, message, "the file is cut short or damaged here", line_span(path, i + 1, line))
        row = [np.nan if cell.lower() in _MISSING[:8] else _number(cell, comma) for cell in cells]
        if None in row:
            wrong = cells[row.index(None)]
            if wrong.lower().strip("+-") in ("nan", "inf", "infinity"):
                row = [np.nan if value is None else value for value in row]
            else:
                message = f"'{wrong[:40]}' is no number"
                reject("MD252", path, message, "give numbers", line_span(path, i + 1, line, wrong))
        rows.append(np.array(row, complex))
    table = np.array(rows)
    return table if table.imag.any() else table.real


def _head(lines: list[str], separator: str | None, width: int) -> tuple[list[str], list[str]]:
    """Names and units of the columns, from the lines before the numbers; without names, numbers from 1."""
    rows = [_cells(line.lstrip().lstrip(_COMMENTS), separator) for line in lines if line.strip()]
    rows = [row[:width] for row in rows if len(row) >= width and not any(row[width:]) and any(row)]
    units = [""] * width
    if len(rows) > 1 and any(unit(cell) for cell in rows[-1]) and _are_units(rows[-1]):
        units, rows = [cell.strip("[]()") for cell in rows[-1]], rows[:-1]
    names = list(rows[-1]) if rows else [""] * width
    for j, name in enumerate(names):
        stem, said = _parted(name)
        if stem and said is not None:
            names[j], units[j] = stem, units[j] or said
    return [name or str(j + 1) for j, name in enumerate(names)], units


def _parted(name: str) -> tuple[str, str | None]:
    """`acc3` and `g` of `acc3 (g)` or `acc3 [g]`; None for a name without a unit."""
    at = min((i for i in (name.find("("), name.find("[")) if i >= 0), default=-1)
    return (name[:at].rstrip(), name[at + 1 : -1]) if at >= 0 and name.endswith((")", "]")) else (name, None)


def _are_units(cells: list[str]) -> bool:
    return all(unit(cell) or cell.strip("[]()").lower() in ("s", "sec", "ms", "hz", "-", "") for cell in cells)


FORMAT = RecordingFormat("csv", _read, ("csv", "txt", "tsv", "dat", "asc"))
