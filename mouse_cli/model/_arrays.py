"""Read-only arrays of a declared shape, dense or sparse."""

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
