"""K - sigma M over one sparsity pattern, so that its symbolic factorisation serves all values of K, M and sigma."""

import numpy as np

from mouse_cli.model.arrays import Matrix

_CHANCES = 2  # pencils of one pattern after which zeros are no longer left out


class Pencil:
    """The union of the patterns of symmetric K and M, and where the entries of either are in it.

    scipy's own difference drops entries that happen to be zero, and with them the pattern. Places where both are zero, of
    which element matrices have many, are left out until something appears in them.

    before: the pencil that did not fit, whose places are kept; after some, all are: what is zero is then so by chance.
    """

    def __init__(self, K: Matrix, M: Matrix, before: "Pencil | None" = None):
        K, M = canonical(K), canonical(M)
        self._of_K, self._of_M = (K.indptr, K.indices), (M.indptr, M.indices)
        union = K if _same(self._of_K, self._of_M) else canonical(_ones(K) + _ones(M))
        self._places = None if union is K else [np.searchsorted(_flat(union), _flat(part)) for part in (K, M)]
        self._size = len(union.indices)
        stiff, mass = self._data(K, M)
        filled = (stiff != 0) | (mass != 0)
        self._made = 1
        if before is not None and before._follows(self):
            self._made += before._made
            filled[before._kept] = True
            filled |= self._made > _CHANCES
        self._kept, self._empty = np.flatnonzero(filled), np.flatnonzero(~filled)
        self.indices = union.indices[self._kept]
        self.indptr = np.searchsorted(self._kept, union.indptr).astype(np.int32)

    def _data(self, K: Matrix, M: Matrix) -> tuple[np.ndarray, np.ndarray]:
        """Values of K and of M over their union."""
        if self._places is None:
            return K.data, M.data
        out = np.zeros((2, self._size))
        for values, places, matrix in zip(out, self._places, (K, M), strict=True):
            values[places] = matrix.data
        return out[0], out[1]

    def _follows(self, other: "Pencil") -> bool:
        """Whether both are of the same patterns."""
        return _same(self._of_K, other._of_K) and _same(self._of_M, other._of_M)

    def fits(self, K: Matrix, M: Matrix) -> bool:
        """Whether K and M have the patterns that this one was made of, and nothing where both were zero."""
        K, M = canonical(K), canonical(M)
        if not (_same(self._of_K, (K.indptr, K.indices)) and _same(self._of_M, (M.indptr, M.indices))):
            return False
        return not any(values[self._empty].any() for values in self._data(K, M))

    def shifted(self, K: Matrix, M: Matrix, sigma: float, precision: type = float) -> Matrix:
        """K - sigma M as scipy.sparse.csr_array, formed and stored in that precision."""
        from scipy.sparse import csr_array

        stiff, mass = (
            values[self._kept].astype(precision, copy=False) for values in self._data(canonical(K), canonical(M))
        )
        data = stiff - precision(sigma) * mass
        matrix = csr_array((data, self.indices, self.indptr), shape=K.shape)
        matrix.has_canonical_format = True
        return matrix


def canonical(matrix: Matrix) -> Matrix:
    """The matrix by rows, indices sorted and once each; not copied when it is so already."""
    matrix = matrix.tocsr()
    if not matrix.has_canonical_format:
        matrix = matrix.copy()
        matrix.sum_duplicates()
    return matrix


def without_zeros(matrix: Matrix) -> Matrix:
    """A copy by rows that stores no zeros: for products."""
    matrix = canonical(matrix).copy()
    matrix.eliminate_zeros()
    return matrix


def _same(one: tuple[np.ndarray, np.ndarray], other: tuple[np.ndarray, np.ndarray]) -> bool:
    return all(a is b or np.array_equal(a, b) for a, b in zip(one, other, strict=True))


def _ones(matrix: Matrix) -> Matrix:
    from scipy.sparse import csr_array

    return csr_array((np.ones(matrix.nnz), matrix.indices, matrix.indptr), shape=matrix.shape)


def _flat(matrix: Matrix) -> np.ndarray:
    """Row by row, the places of the stored entries as single numbers, ascending."""
    n = matrix.shape[0]
    return np.repeat(np.arange(n, dtype=np.int64) * n, np.diff(matrix.indptr)) + matrix.indices
