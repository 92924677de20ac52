"""Comma-separated values (.csv): all rows, or triples under a header `i,j,value`."""

import csv
import os

import numpy as np

from mouse_cli._span import Span
from mouse_cli.formats.data_files import FileFormat, check_memory, reject
from mouse_cli.formats.matrix_files import MAX_ORDER
from mouse_cli.model.arrays import Matrix, sparse_symmetric

_HEADERS = (("i", "j"), ("row", "col"), ("row", "column"))  # and a third word for the value
_MISSING = ("", "nan", "null", "na")
_CELLS = 30  # times the size of the file that its cells take as texts
_LARGEST = 20_000_000  # values of a table: 160 MB


def _read(path: str, _: str | None) -> Matrix:
    check_memory(path, _CELLS * os.path.getsize(path))
    lines = _lines(path)
    rows = [(number, line, _cells(line)) for number, line in lines]
    if not rows:
        reject("MD252", path, "the file holds no values", "give one row of numbers on each line")
    header = [cell.lower() for cell in rows[0][2]]
    if len(header) == 3 and tuple(header[:2]) in _HEADERS:
        return _triples(path, rows[1:])
    if all(_value(cell) is None for cell in header):
        rows = rows[1:]
    return _table(path, rows)


def _lines(path: str) -> list[tuple[int, str]]:
    """Lines that are neither blank nor comments, with their numbers."""
    try:
        with open(path, encoding="utf-8-sig") as stream:
            numbered = enumerate((line.rstrip("\r\n") for line in stream), 1)
            return [(number, line) for number, line in numbered if line.strip() and not line.lstrip().startswith("#")]
    except UnicodeDecodeError:
        reject("MD252", path, "the file is not UTF-8 text", "save it as text with commas")


def _cells(line: str) -> list[str]:
    separator = next((s for s in ",;\t" if s in line), ",")
    return [cell.strip() for cell in next(csv.reader([line], delimiter=separator))]


def _value(cell: str) -> float | None:
    """A number, NaN when the cell is empty; None when it holds something else."""
    if cell.lower() in _MISSING:
        return np.nan
    try:
        return None if "_" in cell else float(cell)
    except ValueError:
        return None


def _table(path: str, rows: list[tuple[int, str, list[str]]]) -> np.ndarray:
    width = len(rows[0][2]) if rows else 0
    if len(rows) * width > _LARGEST:
        message = f"the table has {len(rows)} x {width} values; at most {_LARGEST} are read"
        reject("MD258", path, message, "write a sparse matrix as .mtx")
    return np.array([_row(path, row, width) for row in rows]).reshape(len(rows), width)


def _row(path: str, row: tuple[int, str, list[str]], width: int) -> list[float]:
    number, line, cells = row
    if len(cells) != width:
        message = f"the row has {len(cells)} values; expected {width}, as in the first row"
        reject(
            "MD252",
            path,
            message,
            "give each row the same number of values",
            Span(path, number, 1, len(line), line),
        )
    values = [_value(cell) for cell in cells]
    if None in values:
        cell = cells[values.index(None)]
        span = Span(path, number, line.find(cell) + 1, len(cell), line)
        message = f"'{cell[:40]}' is not a number"
        reject("MD252", path, message, "write numbers with a point, separated by commas", span)
    return values


def _triples(path: str, rows: list[tuple[int, str, list[str]]]) -> Matrix:
    table = _table(path, rows)
    indices = table[:, :2] if len(table) else np.zeros((0, 2))
    bad = np.flatnonzero(~((indices >= 1) & (indices <= MAX_ORDER) & (indices == np.floor(indices))).all(axis=1))
    if not rows or len(bad):
        number, line, _ = rows[bad[0]] if rows else (1, "", [])
        span = Span(path, number, 1, max(1, len(line)), line)
        reject("MD252", path, "no row and column from 1 stand here", "give i,j,value on each line", span)
    row, col, values = table[:, 0].astype(int) - 1, table[:, 1].astype(int) - 1, table[:, 2]
    _no_repetition(path, rows, row, col)
    order = int(max(row.max(), col.max())) + 1
    if (row <= col).all() or (row >= col).all():  # one triangle stands for both
        return sparse_symmetric(row, col, values, order)
    from scipy.sparse import coo_array

    return coo_array((values, (row, col)), shape=(order, order))


def _no_repetition(path: str, rows: list[tuple[int, str, list[str]]], row: np.ndarray, col: np.ndarray) -> None:
    _, first = np.unique(row * MAX_ORDER + col, return_index=True)
    again = np.setdiff1d(np.arange(len(row)), first)
    if len(again):
        number, line, _ = rows[again[0]]
        message = f"({row[again[0]] + 1},{col[again[0]] + 1}) is given twice"
        reject("MD252", path, message, "give each element once", Span(path, number, 1, len(line), line))


FORMAT = FileFormat("csv", _read)
