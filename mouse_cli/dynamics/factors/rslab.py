"""The optional package rslab (mouse-cli[fast]): supernodal L D L', analysed once a pattern, many right-hand sides at once."""

import importlib.util
import os

import numpy as np

from mouse_cli.dynamics.factors import Backend
from mouse_cli.model.arrays import Matrix


class _Symbolic:
    """The analysis of the lower triangle; it reads values in the order of the upper triangle by rows, which is the same."""

    def __init__(self, pattern: Matrix):
        import rslab
        from scipy.sparse import csc_array

        n = pattern.shape[0]
        row = np.repeat(np.arange(n, dtype=np.int32), np.diff(pattern.indptr))
        self._lower = np.flatnonzero(pattern.indices >= row)
        indptr = np.searchsorted(self._lower, pattern.indptr).astype(pattern.indptr.dtype)
        lower = csc_array((np.ones(len(self._lower)), pattern.indices[self._lower], indptr), shape=(n, n))
        threads = int(os.environ.get("OMP_NUM_THREADS") or 1)
        self._symbolic = rslab.analyze(lower, path="ldlt", threads=threads, scaling="none")
        known = self._symbolic.estimate_memory()
        self.memory_bytes = int(known["transient_peak_bytes"])

    def factor(self, matrix: Matrix) -> "_Factor":
        """L D L' of the values of `matrix`."""
        return _Factor(self._symbolic.factor(matrix.data[self._lower]))


class _Factor:
    def __init__(self, ldlt):
        self._ldlt = ldlt

    def solve(self, right: np.ndarray) -> np.ndarray:
        """Blocked, for columns one behind the other."""
        if right.shape[1] == 1:
            return self._ldlt.solve(np.ascontiguousarray(right[:, 0]))[:, None]
        return self._ldlt.solve_many(np.asfortranarray(right))

    def negative(self) -> int | None:
        """From the signs of D; perturbed pivots tell nothing."""
        return None if self._ldlt.n_perturbed else int(self._ldlt.inertia[1])


FACTOR = Backend(
    "rslab",
    "supernodal L D L' of the package rslab (mouse-cli[fast])",
    10,
    lambda: importlib.util.find_spec("rslab") is not None,
    _Symbolic,
)
