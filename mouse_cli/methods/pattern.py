"""K as its elements that are not zero, each relative to what it was: support of the methods that keep the pattern of zeros."""

import numpy as np

from mouse_cli.methods import refusals
from mouse_cli.methods.given import Given

_ZERO = 1e-9  # of the root of the product of diagonals: rounding
_RANK = 1e-6  # of the largest singular value: smaller ones are equations that repeat others, but for rounding
_FREE = 1e-9  # the same of the constraints
MOST_ENTRIES = 30_000_000  # of the equations


class Pattern:
    """The u elements of K0 (n, n) on and above the diagonal that are not zero, and which changes of them are free.

    fixed (n, r): shapes on which the change of K has no force.
    """

    def __init__(self, given: Given, fixed: np.ndarray | None = None):
        self.K, self.M = given.K, given.M
        self.root = np.sqrt(np.abs(self.K.diagonal()))
        there = np.abs(np.triu(self.K)) > _ZERO * np.outer(self.root, self.root)
        self.row, self.col = np.nonzero(there)
        self.values = self.K[self.row, self.col]
        widest = max(len(given.eigenvalues), 0 if fixed is None else fixed.shape[1])
        if len(self.K) * widest * len(self.values) > MOST_ENTRIES:
            raise refusals.too_large(given.problem, "kabe")
        self.free = None if fixed is None or not fixed.shape[1] else self._free(fixed)

    def _free(self, fixed: np.ndarray) -> np.ndarray:
        """Orthonormal changes (u, f), relative, without force on the shapes `fixed`."""
        _, s, Vt = np.linalg.svd(self._forces(fixed))
        return Vt[np.count_nonzero(s > _FREE * s[0]) :].T

    def _forces(self, X: np.ndarray) -> np.ndarray:
        """Forces (m n, u) on shapes X (n, m) by a relative change of each element, by the root of the stiffness of their place."""
        n, m, c = len(self.K), X.shape[1], np.arange(len(self.row))
        found, off = np.zeros((m, n, len(c))), self.row != self.col
        for i in range(m):
            found[i, self.row, c] = self.values * X[self.col, i]
            found[i, self.col[off], c[off]] = self.values[off] * X[self.row[off], i]
        return (found / np.where(self.root > 0, self.root, 1.0)[None, :, None]).reshape(m * n, -1)

    def stiffness(self, X: np.ndarray, eigenvalues: np.ndarray) -> np.ndarray:
        """K with the least relative change for which K X = M X L, or comes nearest to it."""
        inertia = (self.M @ X) * eigenvalues / np.where(self.root > 0, self.root, 1.0)[:, None]
        weight = np.repeat(1 / np.linalg.norm(inertia, axis=0), len(X))
        A = weight[:, None] * self._forces(X)
        A = A if self.free is None else A @ self.free
        U, s, Vt = np.linalg.svd(A, full_matrices=False)
        rank = np.count_nonzero(s > _RANK * s[0])
        K = self._matrix(np.zeros(len(self.values)))
        given = weight * (inertia - (K @ X) / np.where(self.root > 0, self.root, 1.0)[:, None]).T.ravel()
        y = Vt[:rank].T @ ((U[:, :rank].T @ given) / s[:rank])
        y += Vt[:rank].T @ (
            (U[:, :rank].T @ (given - A @ y)) / s[:rank]
        )  # once more: the digits that the first time lost
        return self._matrix(y if self.free is None else self.free @ y)

    def _matrix(self, change: np.ndarray) -> np.ndarray:
        K = np.zeros_like(self.K)
        K[self.row, self.col] = self.values * (1 + change)
        K[self.col, self.row] = K[self.row, self.col]
        return K
