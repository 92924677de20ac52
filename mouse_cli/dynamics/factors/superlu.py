"""scipy's SuperLU, on the diagonal and with an ordering for symmetric matrices: what is always there."""

import numpy as np

from mouse_cli.dynamics.factors import Backend
from mouse_cli.dynamics.factors._dissection import densely_connected, dissected
from mouse_cli.dynamics.memory import nonzeros
from mouse_cli.model.arrays import Matrix


class _Symbolic:
    """SuperLU keeps nothing between factorisations, and tells nothing before: sizes are estimates, of L and U."""

    def __init__(self, pattern: Matrix):
        self.memory_bytes = 2 * 12 * nonzeros(pattern)
        self._order = dissected(pattern) if densely_connected(pattern) else None

    def factor(self, matrix: Matrix) -> "_Factor":
        """L U by diagonal pivots."""
        return _Factor(matrix, self._order)


class _Factor:
    """order (n,): as it is eliminated; None: by minimum degree."""

    def __init__(self, matrix: Matrix, order: np.ndarray | None):
        from scipy.sparse import csc_array
        from scipy.sparse.linalg import splu

        self._order, ordering = order, "MMD_AT_PLUS_A" if order is None else "NATURAL"
        matrix = matrix if order is None else matrix[order][:, order]
        transposed = csc_array((matrix.data, matrix.indices, matrix.indptr), shape=matrix.shape)  # and so the same
        try:
            self._lu = splu(transposed, permc_spec=ordering, diag_pivot_thresh=0.0, options={"SymmetricMode": True})
        except RuntimeError as reason:  # SuperLU's word for an exactly singular matrix
            raise np.linalg.LinAlgError(str(reason)) from None

    def solve(self, right: np.ndarray) -> np.ndarray:
        """Column by column."""
        if self._order is None:
            return self._lu.solve(right)
        x = np.empty(right.shape)
        x[self._order] = self._lu.solve(right[self._order])
        return x

    def negative(self) -> int | None:
        """From the signs of the pivots, where all are on the diagonal."""
        if (self._lu.perm_r != self._lu.perm_c).any():
            return None
        return int(np.count_nonzero(self._lu.U.diagonal() < 0))


FACTOR = Backend("superlu", "SuperLU of scipy, ordered for symmetric matrices", 0, lambda: True, _Symbolic)
