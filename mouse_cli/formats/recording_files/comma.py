"""Tables as text (.csv, .txt, .tsv, .dat, .asc): one line for each sample or line of frequency, one column for each channel.

Columns are separated by semicolons, tabulators, commas or blanks; before the numbers stand any lines, of which the last with as
many cells as there are columns names them, `acc3`, `acc3 (g)`, `acc3 [m/s2]`; a line of units may follow, and lines such as
`Sample rate;1000` or `fs = 512 Hz` state the sampling. Complex numbers are written `0.1+0.2j`. Beside semicolons and tabulators, a
comma in a number is a decimal comma. The first of several columns may hold times of day, `12:00:00.001`, also after an ISO date.
"""

import re
from codecs import BOM_UTF16_BE, BOM_UTF16_LE
from contextlib import suppress
from datetime import date
from itertools import islice

import numpy as np

from mouse_cli.formats.data_files import FileFormat, line_span, reject, text_lines
from mouse_cli.formats.recording_files import MOST_COLUMNS, Column, Contents
from mouse_cli.formats.recording_files.text_head import COMMENTS, labelled, read_head

_MOST_HEAD = 200  # lines before the numbers
_MISSING = ("", "nan", "na", "n/a", "null", "-", "--", "#n/a", "inf", "-inf", "+inf")
_EPOCH = date(1970, 1, 1).toordinal()
_TIME_OF_DAY = re.compile(
    r"(?:(?P<date>[0-9]{4}-[0-9]{2}-[0-9]{2})[ T])?"
    r"(?P<hours>[0-9]{1,2}):(?P<minutes>[0-9]{2}):(?P<seconds>[0-9]{2}(?:[.,][0-9]{1,9})?)Z?",
    re.ASCII,
)
_DECIMAL_COMMA = re.compile(r"[-+]?[0-9]*,[0-9]+([eE][-+]?[0-9]+)?")


def _read(path: str) -> Contents:
    head = _lines(path)
    first, separator = _first(path, head)
    width = _columns(head[first : first + 5], separator)
    values = _at_once(path, first, separator, head[first])
    if values is None or values.shape[1] != width:
        values = _slowly(path, first, separator, width)
    found = read_head(
        head[:first], lambda line: _cells(line, separator), width, _has_decimal_commas(head[first], separator)
    )
    columns = tuple(Column(found.names[j], values[:, j], found.units[j]) for j in range(width))
    return Contents(columns, found.sample_rate_hz)


def _wide(path: str) -> bool:
    """Whether the text is UTF-16, as Windows calls Unicode: it begins with the mark of its order of bytes."""
    with open(path, "rb") as stream:
        return stream.read(2) in (BOM_UTF16_LE, BOM_UTF16_BE)


def _lines(path: str) -> list[str]:
    """The first lines, in UTF-16 or UTF-8 or, where they are neither, in the code page of Western Windows."""
    encodings = [("utf-16", "replace")] if _wide(path) else [("utf-8-sig", "strict"), ("cp1252", "replace")]
    for encoding, errors in encodings:
        with suppress(UnicodeDecodeError), open(path, encoding=encoding, errors=errors, newline=None) as stream:
            return [line.rstrip("\n") for line in islice(stream, _MOST_HEAD)]
    return []


def _first(path: str, lines: list[str]) -> tuple[int, str | None]:
    """The line of the first numbers, from 0, and what separates them."""
    for i, line in enumerate(lines[:_MOST_HEAD]):
        if not line.strip() or line.lstrip()[0] in COMMENTS or labelled(lines, i) not in ("", "data", "values"):
            continue
        separator = next((mark for mark in (";", "\t", ",") if mark in line), None)
        cells = _cells(line, separator)
        if len(cells) > MOST_COLUMNS:
            reject("MD258", path, f"line {i + 1} has more than {MOST_COLUMNS} cells", "divide the table")
        comma = separator in (";", "\t")
        cells = cells[1:] if len(cells) > 1 and _clock(cells[0]) is not None else cells
        if any(_number(cell, comma) is not None for cell in cells) and all(
            _number(cell, comma) is not None or cell.lower() in _MISSING for cell in cells
        ):
            return i, separator
    message = f"none of the first {min(len(lines), _MOST_HEAD)} lines is a row of numbers"
    reject("MD601", path, message, "give a table of numbers")


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


def _clock(cell: str) -> float | None:
    """Seconds from the time of day that a cell spells, after midnight or, with a date, after that of 1970."""
    found = _TIME_OF_DAY.fullmatch(cell)
    if found is None:
        return None
    with suppress(ValueError):
        days = date.fromisoformat(found["date"]).toordinal() - _EPOCH if found["date"] else 0
        hours, minutes = int(found["hours"]), int(found["minutes"])
        return 86400.0 * days + 3600 * hours + 60 * minutes + float(found["seconds"].replace(",", "."))
    return None


def _spelled(text: str, comma: bool) -> str:
    text = text.replace(",", ".") if comma else text
    return text.replace("i", "j").replace(" ", "").replace("jnf", "inf") if "i" in text or " " in text else text


def _at_once(path: str, first: int, separator: str | None, line: str) -> np.ndarray | None:
    """The table (k, c) as numpy reads it, decimal commas included; None where a cell is no plain number."""
    kind, encoding = complex if "j" in line else float, "utf-16" if _wide(path) else "latin-1"
    try:
        if not _has_decimal_commas(line, separator):
            return np.loadtxt(path, kind, None, separator, skiprows=first, ndmin=2, encoding=encoding)
        with open(path, encoding=encoding) as stream:
            return np.loadtxt((row.replace(",", ".") for row in stream), kind, None, separator, skiprows=first, ndmin=2)
    except ValueError:
        return None


def _has_decimal_commas(line: str, separator: str | None) -> bool:
    return separator in (";", "\t") and any(_DECIMAL_COMMA.fullmatch(cell) for cell in _cells(line, separator))


def _slowly(path: str, first: int, separator: str | None, width: int) -> np.ndarray:
    """The table cell by cell: NaN for a cell that is empty or says so, decimal commas, i for j; refuses what is no number."""
    lines = text_lines(path, "utf-16" if _wide(path) else "utf-8-sig", "replace")
    comma = _has_decimal_commas(lines[first], separator)
    rows = []
    last = max(i for i, line in enumerate(lines) if line.strip())
    for i in range(first, last + 1):
        line = lines[i]
        if not line.strip() or line.lstrip()[0] in COMMENTS:
            continue
        cells = _cells(line, separator)
        cells = cells[:width] if not any(cells[width:]) else cells
        if len(cells) != width:
            message = f"the line has {len(cells)} values; the first row of numbers, line {first + 1}, has {width}"
            reject("MD252", path, message, "the file is cut short or damaged here", line_span(path, i + 1, line))
        row = [np.nan if cell.lower() in _MISSING[:8] else _number(cell, comma) for cell in cells]
        row[0] = _clock(cells[0]) if row[0] is None and width > 1 else row[0]
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


FORMAT = FileFormat("csv", _read, ("csv", "txt", "tsv", "dat", "asc"))
