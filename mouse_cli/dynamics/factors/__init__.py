"""Factorisations of symmetric sparse matrices: one module = one backend, found by `registry`; the best installed one is taken."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from mouse_cli import _registry
from mouse_cli.model.arrays import Matrix

RESIDUAL = 1e-6  # |A x - b| over |A| |x| + |b| of one solve above which a factorisation is thrown away
FALLBACK = "superlu"


class Factor(Protocol):
    """A factorised matrix."""

    def solve(self, right: np.ndarray) -> np.ndarray:
        """The solution (n, c) of A x = `right` (n, c)."""
        ...

    def negative(self) -> int | None:
        """Number of negative eigenvalues of A, by the signs of its pivots (Sylvester); None when they do not tell."""
        ...


class Symbolic(Protocol):
    """What can be known of a factorisation from the pattern alone. memory_bytes: at the peak of a factorisation."""

    memory_bytes: int

    def factor(self, matrix: Matrix) -> Factor:
        """Factorisation of a matrix on the pattern that was analysed. Raises numpy.linalg.LinAlgError when it is singular."""
        ...


@dataclass(frozen=True)
class Backend:
    """A way to factorise. `available` tells whether its package is installed; of those, the highest `priority` is taken."""

    key: str
    meaning: str
    priority: int
    available: Callable[[], bool]
    analyze: Callable[[Matrix], Symbolic]


def registry() -> dict[str, Backend]:
    """All backends by key."""
    return _registry.discover(__name__, "FACTOR")


def best() -> Backend:
    """The installed backend of the highest priority."""
    return max(
        (backend for backend in registry().values() if backend.available()), key=lambda backend: backend.priority
    )


class Analysis:
    """A pattern, analysed once; factorisations of matrices on it, each checked by one solve.

    pattern: symmetric scipy.sparse.csr_array with sorted indices, zeros and all. A factorisation that fails the check is
    done again by SuperLU, which from then on does all of them; `backend` tells which one is in use.
    """

    def __init__(self, pattern: Matrix, backend: Backend | None = None):
        self.backend = best() if backend is None else backend
        self.symbolic = self.backend.analyze(pattern)

    def factor(self, matrix: Matrix) -> Factor:
        """The factorisation of a matrix on the pattern. Raises numpy.linalg.LinAlgError when it is singular to rounding."""
        try:
            factor = self.symbolic.factor(matrix)
            if _solves(factor, matrix):
                return factor
            reason = "the factorisation is inaccurate: the matrix is singular to rounding"
        except (np.linalg.LinAlgError, ValueError, RuntimeError) as failure:
            reason = str(failure)
        if self.backend.key == FALLBACK:
            raise np.linalg.LinAlgError(reason)
        self.backend = registry()[FALLBACK]
        self.symbolic = self.backend.analyze(matrix)
        return self.factor(matrix)


def _solves(factor: Factor, matrix: Matrix) -> bool:
    """Whether the factorisation solves for one right-hand side, by the backward error of Rigal and Gaches (1967)."""
    right = np.random.default_rng(0).standard_normal((matrix.shape[0], 1))
    x = factor.solve(right)
    largest = float(np.abs(matrix.data).max(initial=0.0))
    size = largest * np.abs(x).max() + np.abs(right).max()
    return bool(np.isfinite(x).all() and np.abs(matrix @ x - right).max() <= RESIDUAL * size)
