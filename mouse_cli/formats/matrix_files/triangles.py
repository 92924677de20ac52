"""Matrices from lists of entries, of which many formats keep one triangle for both."""

from collections.abc import Callable

import numpy as np

from mouse_cli._span import Span
from mouse_cli.formats.data_files import reject
from mouse_cli.formats.matrix_files import MAX_ORDER
from mouse_cli.model.arrays import Matrix


def completed(
    path: str, row: np.ndarray, col: np.ndarray, values: np.ndarray, n: int, where: Callable[[int], Span] | None = None
) -> Matrix:
    """The symmetric matrix (n, n) of entries, from 0, of one triangle or of both.

    An entry whose mirror image is not given stands for it too; where all mirror images are given, nothing is added. `where(i)`
    is the place of entry i. Raises DeckError: MD252 for an entry given twice, MD255 where only some mirror images are given.
    """
    from scipy.sparse import coo_array

    row, col = row.astype(np.int64), col.astype(np.int64)
    _each_once(path, row * n + col, row, col, where)
    off = np.flatnonzero((row != col) & (values != 0))
    mirrored = np.isin(row[off] * n + col[off], col[off] * n + row[off])
    if mirrored.all():
        off = off[:0]
    elif mirrored.any():
        i = int(off[~mirrored][0])
        message = f"({row[i] + 1},{col[i] + 1}) is given without its mirror image, but other entries with theirs"
        reject("MD255", path, message, "give one triangle, or both whole", where(i) if where else None)
    places = np.concatenate([row, col[off]]), np.concatenate([col, row[off]])
    return coo_array((np.concatenate([values, values[off]]), places), shape=(n, n))


def order(path: str, largest: int, what: str = "index", span: Span | None = None) -> int:
    """The number of rows that `largest`, counted from 1, implies; MD258 when it is too large."""
    if largest > MAX_ORDER:
        reject("MD258", path, f"{what} {largest} is beyond the largest order, {MAX_ORDER}", "check the file", span)
    return largest


def _each_once(path: str, place: np.ndarray, row: np.ndarray, col: np.ndarray, where: Callable | None) -> None:
    sorted_places = np.sort(place)
    if not (sorted_places[1:] == sorted_places[:-1]).any():
        return
    _, first = np.unique(place, return_index=True)
    i = int(np.setdiff1d(np.arange(len(place)), first)[0])
    message = f"({row[i] + 1},{col[i] + 1}) is given twice"
    reject("MD252", path, message, "give each entry once", where(i) if where else None)
