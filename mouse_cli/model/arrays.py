"""Matrices, dense or sparse alike: checked, frozen, made dense, made from or taken apart into single elements."""

from typing import Any

import numpy as np

Matrix = Any  # numpy.ndarray or scipy.sparse array; scipy is imported only where a sparse matrix exists


def is_sparse(matrix: Matrix) -> bool:
    """True for a scipy.sparse matrix or array, without importing scipy."""
    return hasattr(matrix, "tocsr")


def frozen(values: Any, shape: tuple[int, ...], name: str, dtype: type = float) -> np.ndarray:
    """`values` as a C-ordered, read-only array of `shape`; a sparse matrix is checked and passed through.

    Raises ValueError that names the array and both shapes.
    """
    if is_sparse(values):
        if values.shape != shape:
            raise ValueError(f"{name} has shape {values.shape}, expected {shape}")
        return values
    array = np.array(values, dtype=dtype, order="C")
    if array.shape != shape:
        raise ValueError(f"{name} has shape {array.shape}, expected {shape}")
    array.flags.writeable = False
    return array


def freeze(of: object, dtype: type = float, **shapes: tuple[int, ...]) -> None:
    """Arrays of a frozen dataclass by name, each `frozen` in its shape; those that are None stay None."""
    for name, shape in shapes.items():
        if getattr(of, name) is not None:
            object.__setattr__(of, name, frozen(getattr(of, name), shape, name, dtype))


def dense(matrix: Matrix) -> np.ndarray:
    """The matrix as a numpy array; one that is an array already is not copied."""
    return matrix.toarray() if is_sparse(matrix) else matrix


def sparse_symmetric(row: np.ndarray, col: np.ndarray, values: np.ndarray, n: int) -> Matrix:
    """The scipy.sparse.csr_array (n, n) with `values` at the places (row, col), from 0, and at their mirror images.

    An element off the diagonal is given once, on either side; values of one place are summed.
    """
    from scipy.sparse import coo_array

    off = row != col
    places = np.concatenate([row, col[off]]), np.concatenate([col, row[off]])
    return coo_array((np.concatenate([values, values[off]]), places), shape=(n, n)).tocsr()


def upper_triangle(matrix: Matrix) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Rows and columns (from 0) and values of the nonzero elements on and above the diagonal, row by row."""
    if not is_sparse(matrix):
        row, col = np.nonzero(np.triu(matrix))
        return row, col, matrix[row, col]
    stored = matrix.tocoo()
    row, col = (np.asarray(index, dtype=np.int64) for index in (stored.row, stored.col))
    keep = (row <= col) & (stored.data != 0)
    row, col, values = row[keep], col[keep], stored.data[keep]
    order = np.lexsort((col, row))
    return row[order], col[order], values[order]
