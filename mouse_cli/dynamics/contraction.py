"""dK_j and dM_j of all properties as two sparse matrices, row under row: one product each gives the forces on all mode shapes."""

import numpy as np

from mouse_cli.model.arrays import Matrix
from mouse_cli.model.term import CONSTANT, Slopes

_MARKS = 500_000_000  # rows by properties for which marks fit into memory


class Stack:
    """The rows of dK_j and dM_j that are not zero, property j under property j - 1, t in all.

    rows (t,): degree of freedom of each; start (p + 1,): where each property begins. K, M (t, n).
    """

    def __init__(self, n: int, p: int, slopes: dict[str, Slopes]):
        self._n, self.p = n, p
        parts = [slopes.get(name, CONSTANT) for name in ("K", "M")]
        keys = [part.parameter.astype(np.int64) * n + part.row for part in parts]
        present, places = _numbered(keys, n * p)
        self.rows = (present % n).astype(np.int32)
        self.start = np.searchsorted(present, np.arange(p + 1, dtype=np.int64) * n)
        self.K, self.M = (self._matrix(part, place, len(present)) for part, place in zip(parts, places, strict=True))

    def _matrix(self, part: Slopes, row: np.ndarray, t: int) -> Matrix:
        from scipy.sparse import coo_array

        return coo_array((part.value, (row, part.col.astype(np.int32, copy=False))), shape=(t, self._n)).tocsr()

    def forces(
        self, first: int, last: int, shapes: np.ndarray, eigenvalues: np.ndarray
    ) -> tuple[np.ndarray, np.ndarray | None]:
        """(dK_j - lambda_i dM_j) x_i and dM_j x_i (t', m) of properties `first` to `last`, for shapes (n, m) by rows.

        The second is None where they move no mass.
        """
        rows = slice(self.start[first], self.start[last])
        forces, inertia = (rows_of(matrix, rows) @ shapes if matrix.nnz else None for matrix in (self.K, self.M))
        if inertia is None:
            return forces, None
        moved = inertia * -eigenvalues
        return (moved if forces is None else moved + forces), inertia

    def chunks(self, rows: int, properties: int) -> list[tuple[int, int]]:
        """Properties from, to (exclusive), about so many rows and at most so many properties at a time."""
        out, first = [], 0
        while first < self.p:
            last = int(np.searchsorted(self.start, self.start[first] + rows, side="right")) - 1
            last = min(max(last, first + 1), first + properties, self.p)
            out.append((first, last))
            first = last
        return out

    def sums(self, first: int, last: int, values: np.ndarray) -> np.ndarray:
        """Sums (last - first, m) of `values` (t', m) over the rows of each property."""
        start = self.start[first : last + 1] - self.start[first]
        total = np.zeros((last - first, values.shape[1]), values.dtype)
        filled = np.flatnonzero(np.diff(start))
        if len(filled):
            total[filled] = np.add.reduceat(values, start[filled], axis=0)
        return total


def rows_of(matrix: Matrix, rows: slice) -> Matrix:
    """Those rows of a scipy.sparse.csr_array, without copying what is in them."""
    from scipy.sparse import csr_array

    first, last = matrix.indptr[rows.start], matrix.indptr[rows.stop]
    part = matrix.data[first:last], matrix.indices[first:last], matrix.indptr[rows.start : rows.stop + 1] - first
    return csr_array(part, shape=(rows.stop - rows.start, matrix.shape[1]))


def _numbered(keys: list[np.ndarray], most: int) -> tuple[np.ndarray, list[np.ndarray]]:
    """The numbers (t,) below `most` that occur in any of `keys`, ascending, and which of them each key is.

    By marks, as sorting takes ten times longer; where there is no room for marks, by sorting.
    """
    if most > _MARKS:
        present = np.unique(np.concatenate([np.unique(key) for key in keys]))
        return present, [np.searchsorted(present, key).astype(np.int32) for key in keys]
    mark = np.zeros(most, bool)
    for key in keys:
        mark[key] = True
    present, place = np.flatnonzero(mark), np.cumsum(mark, dtype=np.int32)
    return present, [place[key] - np.int32(1) for key in keys]
