"""Nastran DMIG cards (.pch, .bdf, .dat, .nas): matrices whose rows and columns are grid points and components.

A header (name, 0, form, type ...), then for each column its point and component and, in groups of four fields, the point,
component and value of each row. Form 6 keeps one triangle.
"""

import numpy as np

from mouse_cli.formats.data_files import FileFormat, reject
from mouse_cli.formats.matrix_files import Contents, choose
from mouse_cli.formats.matrix_files.triangles import completed, order
from mouse_cli.formats.nastran_fields import Bulk, Card
from mouse_cli.model.dof_map import DofMap

_SYMMETRIC, _SQUARE = 6, 1
_COMPONENTS = 7  # 0 for a scalar point, 1 to 6 for a grid point


def _read(path: str, variable: str | None) -> Contents:
    bulk = Bulk(path)
    headers: dict[str, Card] = {}
    columns: dict[str, list[Card]] = {}
    for card in bulk.cards("DMIG"):
        name = card.fields[0].upper()
        if card.fields[1] == "0":
            headers.setdefault(name, card)
        else:
            columns.setdefault(name, []).append(card)
    name = choose(path, variable, list(headers))
    _real_and_square(bulk, headers[name])
    row, col, values, lines = _entries(bulk, columns.get(name, []))
    if not len(values):
        reject("MD252", path, f"matrix {name} has no columns", "write the file again", bulk.where(headers[name]))
    places, index = np.unique(np.concatenate([row, col]), return_inverse=True)
    n = order(path, len(places), "number of rows")
    where = lambda i: bulk.where(lines[i])
    triangle = bulk.whole(headers[name], 2) == _SYMMETRIC
    i, j = index[: len(row)], index[len(row) :]
    matrix = completed(path, i, j, values, n, where) if triangle else _as_given(i, j, values, n)
    return Contents(matrix, DofMap(places // _COMPONENTS, places % _COMPONENTS - 1))


def _real_and_square(bulk: Bulk, header: Card) -> None:
    form, kind = bulk.whole(header, 2), bulk.whole(header, 3)
    if kind in (3, 4):
        message = f"matrix {header.fields[0]} is complex (type {kind}); K and M are real"
        reject("MD253", bulk.path, message, "write a real matrix", bulk.where(header))
    if form not in (_SYMMETRIC, _SQUARE):
        message = f"matrix {header.fields[0]} has form {form}; 6 is symmetric, 1 square"
        reject("MD254", bulk.path, message, "write all rows and columns", bulk.where(header))


def _entries(bulk: Bulk, cards: list[Card]) -> tuple[np.ndarray, np.ndarray, np.ndarray, list[Card]]:
    """Row and column, as point * 7 + component, and value of each entry, and its card."""
    found: list[tuple[int, int, float]] = []
    lines: list[Card] = []
    for card in cards:
        column = _point(bulk, card, 1)
        for field in range(4, len(card.fields), 4):
            if card.fields[field]:
                found.append((_point(bulk, card, field), column, bulk.real(card, field + 2)))
                lines.append(card)
    table = np.array(found, dtype=float).reshape(-1, 3)
    return table[:, 0].astype(np.int64), table[:, 1].astype(np.int64), table[:, 2], lines


def _point(bulk: Bulk, card: Card, field: int) -> int:
    point, component = bulk.whole(card, field, 1), bulk.whole(card, field + 1)
    if component >= _COMPONENTS:
        bulk.refuse(card, f"component {component} of point {point}; components are 1 to 6, or 0 for a scalar point")
    return point * _COMPONENTS + component


def _as_given(row: np.ndarray, col: np.ndarray, values: np.ndarray, n: int):
    from scipy.sparse import coo_array

    return coo_array((values, (row, col)), shape=(n, n))


FORMAT = FileFormat("dmig", _read, ("pch", "bdf", "dat", "nas", "dmig"), named=True)
