"""The yardstick: a good user's eigensolution, ARPACK around the fastest factorisation that is installed.

rslab where it can be imported, its symbolic analysis done once a model; else SuperLU ordered by minimum degree.
"""

import numpy as np

TOLERANCE = 1e-9  # of ARPACK, relative


def shift(K, M, symbolic: "Symbolic | None" = None) -> float:
    """A shift below all eigenvalues, near the lowest one: -0.3 times its estimate, by a few inverse iterations."""
    solve = factorise(K, M, -1e-6 * float(np.median(K.diagonal() / M.diagonal())), symbolic)
    x = np.random.default_rng(0).standard_normal(K.shape[0])
    for _ in range(6):
        x = solve(M @ (x / np.linalg.norm(x)))
    return -0.3 * float(x @ (K @ x)) / float(x @ (M @ x))


class Symbolic:
    """What a factorisation of a matrix can use again for other values on its pattern; nothing without rslab."""

    def __init__(self, A, threads: int = 1):
        try:
            import rslab
        except ImportError:
            self.analysis = None
            return
        self.analysis = rslab.analyze(lower(A), path="ldlt", threads=threads)


def lower(matrix):
    """Lower triangle in compressed columns, as both the symmetric solvers and Harwell-Boeing files have it."""
    from scipy.sparse import tril

    return tril(matrix).tocsc()


def shifted(K, M, sigma: float):
    """K - sigma M; where both have one pattern it is kept, for scipy's difference drops what happens to be zero."""
    from scipy.sparse import csr_array

    if K.nnz != M.nnz or not np.array_equal(K.indices, M.indices):
        return K - sigma * M
    return csr_array((K.data - sigma * M.data, K.indices, K.indptr), shape=K.shape)


def factorise(K, M, sigma: float, symbolic: Symbolic | None = None):
    """The function that solves (K - sigma M) x = b, for b (n,) or (n, c)."""
    A = shifted(K, M, sigma)
    symbolic = Symbolic(A) if symbolic is None else symbolic
    if symbolic.analysis is None:
        from scipy.sparse.linalg import splu

        return splu(A.tocsc(), permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options={"SymmetricMode": True}).solve
    factor = symbolic.analysis.factor(lower(A))
    return lambda b: factor.solve(b) if b.ndim == 1 else factor.solve_many(b)


def arpack(K, M, sigma: float, solve, count: int) -> tuple[np.ndarray, np.ndarray]:
    """The lowest `count` eigenvalues, ascending, and mass-normalised shapes (n, count)."""
    from scipy.sparse.linalg import LinearOperator, eigsh

    n = K.shape[0]
    inverse = LinearOperator((n, n), matvec=solve, dtype=float)
    start = np.random.default_rng(0).standard_normal(n)
    eigenvalues, shapes = eigsh(K, count, M, sigma=sigma, OPinv=inverse, v0=start, tol=TOLERANCE)
    order = np.argsort(eigenvalues)
    return eigenvalues[order], shapes[:, order]
