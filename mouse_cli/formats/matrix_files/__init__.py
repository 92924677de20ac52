"""Matrices kept in files: one module = one format; here, what every matrix of a model must be."""

import os
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from mouse_cli import _registry
from mouse_cli._errors import ERROR, DeckError, Diagnostic
from mouse_cli._span import Span
from mouse_cli.model.arrays import Matrix, dense, is_sparse, upper_triangle

MAX_BYTES = 2_000_000_000  # of a file, and of what is packed in it
MAX_ORDER = 1_000_000  # fits a workstation only when sparse; beyond it an order is a slip
LARGEST_DENSE = 500  # smaller matrices are kept dense: sparse bookkeeping would cost more than the zeros
# Mirror images may differ by so much of the geometric mean of their diagonals: printed digits, no slip.
ROUNDING = 1e-8


@dataclass(frozen=True, slots=True)
class MatrixFormat:
    """A format: `key` is the suffix of its files; `read(path)` gives a real array, dense or sparse."""

    key: str
    read: Callable[[str], Matrix]


def read_matrix(path: str, order: int | None = None) -> Matrix:
    """A symmetric matrix (n, n), dense up to order 500, beyond that a scipy.sparse.csr_array.

    Raises DeckError (MD250 to MD259) that names the file, and its line where a text file has one.
    """
    matrix = _read(path)
    if matrix.ndim != 2 or matrix.shape[0] != matrix.shape[1] or not matrix.shape[0]:
        reject(
            "MD254",
            path,
            f"the matrix has shape {matrix.shape}; it must be square",
            "give all rows and columns",
        )
    n = matrix.shape[0]
    if n > MAX_ORDER:
        reject("MD258", path, f"the matrix has order {n}; at most {MAX_ORDER} is read", "condense the model")
    if order is not None and n != order:
        reject(
            "MD257",
            path,
            f"the matrix has order {n}, but the model has {order}",
            f"give a matrix of order {order}",
        )
    if n <= LARGEST_DENSE:
        return _symmetric(path, _finite(path, dense(matrix)))
    return _symmetric(path, _finite(path, _csr(matrix)))


def read_table(path: str) -> np.ndarray:
    """A dense table of any shape, NaN where a value is missing, e.g. mode shapes."""
    table = _read(path)
    table = np.asarray(dense(table), dtype=float)
    if table.ndim != 2:
        reject(
            "MD254",
            path,
            f"the array has shape {table.shape}; a table has rows and columns",
            "save a 2-D array",
        )
    return table


def reject(code: str, path: str, message: str, help: str = "", span: Span | None = None) -> None:
    """Raise the DeckError of one finding."""
    raise DeckError(Diagnostic(code, ERROR, message, span or Span(path, 1), help=help))


def _read(path: str) -> Matrix:
    _check_file(path)
    suffix = os.path.splitext(path)[1].lower().removeprefix(".")
    formats = _registry.discover(__name__, "FORMAT")
    if suffix not in formats:
        known = ", ".join(f".{key}" for key in formats)
        reject("MD251", path, f"'.{suffix}' is no matrix format", f"give one of {known}")
    try:
        return formats[suffix].read(path)
    except (OSError, MemoryError) as error:
        reject("MD250", path, f"the file cannot be read: {error}", "check the file and its permissions")


def _check_file(path: str) -> None:
    if not os.path.exists(path):
        reject("MD250", path, "there is no such file", "check the name; paths are relative to the deck")
    if not os.path.isfile(path):
        reject("MD250", path, "this is not a file", "give the name of a matrix file")
    size = os.path.getsize(path)
    if size > MAX_BYTES:
        reject("MD258", path, f"the file has {size} bytes; at most {MAX_BYTES} are read", "condense the model")


def _csr(matrix: Matrix) -> Matrix:
    from scipy.sparse import csr_array

    stored = csr_array(matrix)
    stored.sum_duplicates()
    stored.eliminate_zeros()
    return stored


def _finite(path: str, matrix: Matrix) -> Matrix:
    """The matrix as float64, none of its values NaN or infinite."""
    if is_sparse(matrix):
        stored = matrix.tocoo()
        bad = np.flatnonzero(~np.isfinite(stored.data))
        at = [(int(stored.row[i]), int(stored.col[i])) for i in bad[:1]]
    else:
        bad = np.argwhere(~np.isfinite(matrix))
        at = [tuple(index) for index in bad[:1].tolist()]
    for i, j in at:
        message = f"{len(bad)} values are not finite, first the one at ({i + 1},{j + 1})"
        reject("MD256", path, message, "give finite numbers")
    return matrix.astype(float)


def _symmetric(path: str, matrix: Matrix) -> Matrix:
    """The matrix with mirror images made equal, when they differ by rounding alone."""
    difference = abs(matrix - matrix.T)
    row, col, gap = upper_triangle(difference)
    if not len(row):
        return matrix
    diagonal = np.sqrt(np.abs(matrix.diagonal()))
    scale = np.maximum(diagonal[row] * diagonal[col], np.abs(np.ravel(matrix[row, col])))
    wrong = np.flatnonzero(gap > ROUNDING * scale)
    if len(wrong):
        i, j = int(row[wrong[0]]), int(col[wrong[0]])
        message = (
            f"the matrix is not symmetric: ({i + 1},{j + 1}) is {matrix[i, j]:.10g}, "
            f"but ({j + 1},{i + 1}) is {matrix[j, i]:.10g}; {len(wrong)} such pairs"
        )
        reject("MD255", path, message, "give both triangles, or in Matrix Market the lower one and 'symmetric'")
    return (matrix + matrix.T) / 2
