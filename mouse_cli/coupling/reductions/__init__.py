"""Reductions of a substructure to few coordinates that keep its boundary; one file = one method, found by `registry`."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from mouse_cli import _registry
from mouse_cli.dynamics.condensation import LooseError, bordered
from mouse_cli.dynamics.eigen import EigenSolution
from mouse_cli.dynamics.solver import EigenSolver
from mouse_cli.model.arrays import Matrix, dense, is_sparse

_NOTHING = 1e-10  # of the static flexibility: what modes leave of it is rounding
_RIGID = 1e-9  # of the stiffness by mass: the eigenvalue of a rigid-body mode


@dataclass(frozen=True)
class Reduced:
    """u = T q with q' K q and q' M q (q, q); boundary (b, q): motion of the b places at which the part is joined."""

    K: np.ndarray
    M: np.ndarray
    boundary: np.ndarray


class Part:
    """A substructure to be reduced: K, M (n, n) and what its b boundary places read, S (b, n), sparse; what methods ask for
    twice is kept."""

    def __init__(self, K: Matrix, M: Matrix, S: Matrix):
        self.K, self.M, self.S, self.n = K, M, S, K.shape[0]
        self._found: dict[str, EigenSolution] = {}

    def free_modes(self, keep: int) -> tuple[np.ndarray, np.ndarray]:
        """Lowest eigenvalues (k,) and shapes (n, k) of the part as it is, k = min(keep, all that have mass); rigid-body modes
        among them."""
        return self._modes("free", self.K, self.M, keep)

    def held_modes(self, keep: int) -> tuple[np.ndarray, np.ndarray]:
        """Those with S u = 0."""
        L = self._kernel
        if L.shape[1] == 0 or keep == 0:
            return np.zeros(0), np.zeros((self.n, 0))
        lam, X = self._modes("held", _congruent(L, self.K), _congruent(L, self.M), keep)
        return lam, L @ X

    @cached_property
    def _kernel(self) -> Matrix:
        from mouse_cli.coupling.whole import kernel

        return kernel(self.S)

    def _modes(self, which: str, K: Matrix, M: Matrix, keep: int) -> tuple[np.ndarray, np.ndarray]:
        keep = min(keep, K.shape[0])
        before = self._found.get(which)
        if before is None or (len(before.eigenvalues) < keep and not before.complete):
            self._found[which] = before = EigenSolver().solve(K, M, max(keep, 1))
        return before.eigenvalues[:keep], before.shapes[:, :keep]

    @cached_property
    def rigid(self) -> np.ndarray:
        """Rigid-body modes (n, r), mass-normalised."""
        K, M = self.K.diagonal(), self.M.diagonal()
        size = float((K[M > 0] / M[M > 0]).max(initial=0.0))
        lam, X = self.free_modes(min(self.n, 12))
        return X[:, np.abs(lam) <= _RIGID * size]

    @cached_property
    def constraint_modes(self) -> np.ndarray:
        """Static shapes (n, b) for a unit motion of each place with the others held; of K - sigma M where K alone leaves the
        part loose."""
        b = self.S.shape[0]
        none, unit = np.zeros((self.n, b)), np.eye(b)
        try:
            found = bordered(self.K, self.S)(none, unit)[0]
            if np.isfinite(found).all() and np.abs(found).max(initial=0.0) < 1e8:
                return found
        except LooseError:
            pass
        return bordered(self.K + self._shift * self.M, self.S)(none, unit)[0]

    @property
    def _shift(self) -> float:
        lam = self.free_modes(min(self.n, 12))[0]
        elastic = lam[lam > _RIGID * lam.max(initial=0.0)]
        return 0.3 * float(elastic[0]) if len(elastic) else 1.0

    @cached_property
    def attachment_modes(self) -> np.ndarray:
        """Elastic static shapes (n, b) for a unit force at each place, free of rigid-body motion: K u = (I - M R R') f, R'M u
        = 0."""
        from scipy.sparse import csr_array

        R = self.rigid
        loads = self.S.T.toarray()
        rigid = csr_array((self.M @ R).T) if R.shape[1] else csr_array((0, self.n))
        return bordered(self.K, rigid)(loads, np.zeros((R.shape[1], loads.shape[1])))[0]

    def residual_modes(self, keep: int) -> np.ndarray:
        """What the kept modes leave of the attachment modes, (n, r): Psi = (K^+ - Phi Lambda^-1 Phi') f, with forces f for
        which the boundary moves by orthonormal vectors; where the modes leave nothing there is none."""
        lam, X = self.free_modes(keep)
        elastic = X[:, self.rigid.shape[1] :]
        loads = self.S.T.toarray()
        left = self.attachment_modes - elastic @ ((elastic.T @ loads) / lam[self.rigid.shape[1] :, None])
        F = self.S @ left
        full = np.diag(self.S @ self.attachment_modes)
        w, U = np.linalg.eigh((F + F.T) / 2)
        kept = w > _NOTHING * np.abs(full).max(initial=0.0)
        return left @ (U[:, kept] / w[kept])

    def projected(self, T: np.ndarray) -> Reduced:
        """Ritz's matrices on the columns of T (n, q)."""
        return Reduced(_symmetric(T.T @ (self.K @ T)), _symmetric(T.T @ (self.M @ T)), self.S @ T)


def _congruent(L: Matrix, A: Matrix) -> Matrix:
    found = L.T @ (A @ L)
    return found.tocsr() if is_sparse(A) else dense(found)


def _symmetric(A: np.ndarray) -> np.ndarray:
    return (A + A.T) / 2


@dataclass(frozen=True)
class Reduction:
    """A method: reduce(part, keep) with `keep` modes of the part."""

    key: str
    title: str
    equation: str
    reduce: Callable[[Part, int], Reduced]


def registry() -> dict[str, Reduction]:
    """All methods by key."""
    return _registry.discover(__name__, "REDUCTION")


def reduction(key: str) -> Reduction:
    """The method called `key`. Raises ValueError that lists the known ones."""
    return _registry.member(__name__, "REDUCTION", key, "reduction")
