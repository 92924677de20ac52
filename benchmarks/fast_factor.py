"""The yardstick: a good user's eigensolution, ARPACK around the fastest factorisation that is installed.

rslab where it can be imported, its symbolic analysis done once a model; else SuperLU ordered by minimum degree.
"""

import numpy as np

TOLERANCE = 1e-9  # of ARPACK, relative


class Symbolic:
    """The pattern that K - sigma M has for all values of K, M and sigma, and its analysis; no analysis without rslab.

    scipy's own difference drops entries that happen to be zero, and with them the pattern.
    """

    def __init__(self, K, M, threads: int = 1):
        from scipy.sparse import csr_array, tril

        one, other = (csr_array((np.ones(part.nnz), part.indices, part.indptr), shape=part.shape) for part in (K, M))
        lower = tril(one + other).tocsc()
        lower.sort_indices()
        self.n, self.indices, self.indptr = K.shape[0], lower.indices, lower.indptr
        places = _flat(self.indices, self.indptr)
        self.position = [_positions(places, part) for part in (K, M)]
        try:
            import rslab
        except ImportError:
            self.analysis = None
            return
        self.analysis = rslab.analyze(lower, path="ldlt", threads=threads)

    def shifted(self, K, M, sigma: float) -> np.ndarray:
        """Values of the lower triangle of K - sigma M, by columns."""
        (own_K, at_K), (own_M, at_M) = self.position
        values = np.zeros(len(self.indices))
        values[at_K] = K.data[own_K]
        values[at_M] -= sigma * M.data[own_M]
        return values


def _flat(indices: np.ndarray, indptr: np.ndarray) -> np.ndarray:
    n = len(indptr) - 1
    return np.repeat(np.arange(n, dtype=np.int64) * n, np.diff(indptr)) + indices


def _positions(places: np.ndarray, matrix) -> tuple[np.ndarray, np.ndarray]:
    """Entries of a symmetric matrix by rows that are its lower triangle by columns, and where they are in the pattern."""
    row = np.repeat(np.arange(matrix.shape[0]), np.diff(matrix.indptr))
    own = np.flatnonzero(matrix.indices >= row)
    return own, np.searchsorted(places, _flat(matrix.indices, matrix.indptr)[own])


def shift(K, M, symbolic: Symbolic) -> float:
    """A shift below all eigenvalues, near the lowest one: -0.3 times its estimate, by a few inverse iterations."""
    solve = factorise(K, M, -1e-6 * float(np.median(K.diagonal() / M.diagonal())), symbolic)
    x = np.random.default_rng(0).standard_normal(K.shape[0])
    for _ in range(6):
        x = solve(M @ (x / np.linalg.norm(x)))
    return -0.3 * float(x @ (K @ x)) / float(x @ (M @ x))


def factorise(K, M, sigma: float, symbolic: Symbolic):
    """The function that solves (K - sigma M) x = b, for b (n,) or (n, c)."""
    values = symbolic.shifted(K, M, sigma)
    if symbolic.analysis is not None:
        factor = symbolic.analysis.factor(values)
        return lambda b: factor.solve(b) if b.ndim == 1 else factor.solve_many(b)
    from scipy.sparse import csc_array, tril
    from scipy.sparse.linalg import splu

    lower = csc_array((values, symbolic.indices, symbolic.indptr), shape=(symbolic.n, symbolic.n))
    A = (lower + tril(lower, -1).T).tocsc()
    return splu(A, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options={"SymmetricMode": True}).solve


def arpack(K, M, sigma: float, solve, count: int) -> tuple[np.ndarray, np.ndarray]:
    """The lowest `count` eigenvalues, ascending, and mass-normalised shapes (n, count)."""
    from scipy.sparse.linalg import LinearOperator, eigsh

    n = K.shape[0]
    inverse = LinearOperator((n, n), matvec=solve, dtype=float)
    start = np.random.default_rng(0).standard_normal(n)
    eigenvalues, shapes = eigsh(K, count, M, sigma=sigma, OPinv=inverse, v0=start, tol=TOLERANCE)
    order = np.argsort(eigenvalues)
    return eigenvalues[order], shapes[:, order]
