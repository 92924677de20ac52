"""Numbers of a table with the digits that count, one number of decimals down a column where one fits."""

from collections.abc import Sequence
from dataclasses import replace
from math import floor, isfinite, log10

from mouse_cli.report.blocks import Cell, Column, Table

_USUAL, _EACH = 5, 4  # digits of columns that do not say how many; of cells that have no decimals in common
_LARGE, _SMALL = 1e7, 1e-4  # beyond them numbers have an exponent


def rounded(table: Table) -> Table:
    """`table` with its real numbers as text, as short as its columns ask for."""
    if not table.rows:
        return table
    columns = [
        _column(column, cells) for column, cells in zip(table.columns, zip(*table.rows, strict=True), strict=True)
    ]
    return replace(table, rows=tuple(zip(*columns, strict=True)))


def _column(column: Column, cells: Sequence[Cell]) -> list[Cell]:
    digits = column.digits or _USUAL
    sizes = [abs(cell) for cell in cells if isinstance(cell, float) and isfinite(cell) and cell != 0]
    places = _places(sizes, digits)
    if column.unit == "%" and places is None:
        places = _most(sizes, digits)
    each = min(digits, _EACH)
    return [_written(cell, each, places) if isinstance(cell, float) and isfinite(cell) else cell for cell in cells]


def _places(sizes: Sequence[float], digits: int) -> int | None:
    """Decimals for all of them; None where the largest and the smallest have none in common that shows both.

    >>> _places([226.81, 537.43], 5), _places([2e11, 7800.0], 4), _places([], 5)
    (2, None, 0)
    """
    if not sizes:
        return 0
    largest, smallest = max(sizes), min(sizes)
    if not _SMALL <= largest < _LARGE:
        return None
    places = _decimals(largest, digits)
    return places if smallest >= 0.5 * 10.0**-places else None


def _most(sizes: Sequence[float], digits: int) -> int | None:
    """Decimals that show half of the errors at least: the others are none beside the largest; None where they are more."""
    if not _SMALL <= max(sizes) < _LARGE:
        return None
    places = _decimals(max(sizes), digits)
    return places if 2 * sum(size >= 0.5 * 10.0**-places for size in sizes) >= len(sizes) else None


def _decimals(largest: float, digits: int) -> int:
    return max(0, digits - 1 - floor(log10(largest)))


def _written(value: float, digits: int, places: int | None) -> str:
    """`value` with `places` decimals, or else with so many digits.

    >>> _written(-0.00001, 3, 1), _written(7.2e10, 4, None), _written(1346.76, 4, None)
    ('0.0', '7.200e+10', '1347')
    """
    if places is not None:
        return f"{value:.{places}f}" if round(value, places) else f"{0:.{places}f}"
    if value and not _SMALL <= abs(value) < _LARGE:
        return f"{value:.{digits - 1}e}"
    size = floor(log10(abs(value))) if value else 0
    return f"{value:.{max(0, digits - 1 - size)}f}"
