"""Block Krylov spaces of A^-1 M, for A = K - sigma M positive definite, in the inner product of A.

There A^-1 M is symmetric although M may be singular, and the product of A with a new vector is the right-hand side it was solved
for, so that orthogonalisation needs no product with K. Eigenvalues theta of A^-1 M belong to lambda = sigma + 1 / theta: the
lowest modes come first, degrees of freedom without mass, theta = 0, never.
"""

import numpy as np

from mouse_cli.dynamics.factors import Factor
from mouse_cli.dynamics.workspace import Workspace
from mouse_cli.model.arrays import Matrix

BLOCK = 8  # columns at once: fewer are slower for each right-hand side, more need more of them
_DOUBTFUL = 1e-3  # length left of a vector after orthogonalisation, of what it was, below which it is solved for anew
_NOTHING = 1e-13  # the same: rounding alone
_DEPENDENT = 1e-13  # the same for a combination of the vectors left


class Operator:
    """A = K - sigma M by its `factor`, and M without stored zeros; vectors are rows here (c, n), one behind the other.

    noise: a bound of what rounding makes of the lowest mode in a solution, relative. extended: A in extended precision, where
    solutions are to be refined: what the rounding of A and of its factor does to the lowest modes of a slender structure is then
    gone (Wilkinson 1963, ch. 3).
    """

    def __init__(self, factor: Factor, M: Matrix, noise: float = 0.0, extended: Matrix | None = None):
        self.factor, self.M, self.noise, self._extended = factor, M, noise, extended

    @property
    def refined(self) -> bool:
        """Whether solutions are refined."""
        return self._extended is not None

    def solve(self, right: np.ndarray) -> np.ndarray:
        """A^-1 `right`."""
        return np.ascontiguousarray(self.columns(right.T).T)

    def columns(self, right: np.ndarray) -> np.ndarray:
        """A^-1 `right`, of columns (n, c)."""
        x = self.factor.solve(right)
        if self.refined:
            x = x + self.factor.solve((right - self._stiff(x.T).T).astype(float))
        return x

    def quotients(self, X: np.ndarray, MX: np.ndarray) -> np.ndarray:
        """x'A x / x'M x (k,) of vectors (k, n), in extended precision: only where solutions are refined."""
        return (np.sum(X * self._stiff(X), axis=1) / np.sum(X * MX, axis=1)).astype(float)

    def residual(self, X: np.ndarray, MX: np.ndarray, mu: np.ndarray) -> np.ndarray:
        """A x - mu M x of vectors (k, n), in extended precision: only where solutions are refined."""
        return (self._stiff(X) - mu.astype(np.longdouble)[:, None] * MX).astype(float)

    def _stiff(self, X: np.ndarray) -> np.ndarray:
        return (self._extended @ np.ascontiguousarray(X.T).astype(np.longdouble)).T

    def mass(self, vectors: np.ndarray) -> np.ndarray:
        """M times `vectors`."""
        return np.ascontiguousarray((self.M @ np.ascontiguousarray(vectors.T)).T)


class Krylov:
    """V (d, n) with V A V' = I; AV (d, n); T = V M V', known but for the last block, which is still to be expanded.

    `reached`: vectors before the last block; A^-1 M of them lies within V.
    """

    def __init__(
        self, operator: Operator, room: int, workspace: Workspace | None = None, before: np.ndarray | None = None
    ):
        self.operator, self.n = operator, operator.M.shape[0]
        self.workspace = Workspace() if workspace is None else workspace
        self.d = self.reached = self._expanded = 0
        self._before = (
            np.zeros((0, self.n)) if before is None else before
        )  # A V of the first vectors, held by another one
        own = room - len(self._before)
        self._V, self._AV = (self.workspace.array(name, (k, self.n)) for name, k in (("V", room), ("AV", own)))
        self._T = np.zeros((room, room))
        self.known = None  # what it converged to, where rounding needs it

    @property
    def V(self) -> np.ndarray:
        """All vectors (d, n)."""
        return self._V[: self.d]

    @property
    def T(self) -> np.ndarray:
        """V M V' of the vectors that were expanded (reached, reached)."""
        return self._T[: self.reached, : self.reached]

    @property
    def last_reached(self) -> slice:
        """The block that was expanded last: only it is coupled with the one after."""
        return slice(self._expanded, self.reached)

    @property
    def coupling(self) -> np.ndarray:
        """V M V' between the last block and those before it (d - reached, reached)."""
        return self._T[self.reached : self.d, : self.reached]

    @property
    def current(self) -> bool:
        """Whether its vectors are still those of the solution they belong to."""
        return self.operator is not None

    def end(self) -> None:
        """Give up the factorisation; the memory of the vectors is about to be used again."""
        self.operator = None

    def start(self, block: np.ndarray) -> None:
        """Add A^-1 M `block` (c, n): what of it is new."""
        R = self.operator.mass(block)
        self.append(self.operator.solve(R), R)

    def expand(self) -> bool:
        """One step: A^-1 M times the last block. False when nothing new came of it: the space is invariant."""
        first, last = self.reached, self.d
        R = self.operator.mass(self._V[first:last])
        h, C = self.append(self.operator.solve(R), R, max(0, first - (last - first)))
        self._T[:last, first:last] = h
        self._T[first:last, :last] = h.T
        self._T[last : self.d, first:last] = C
        self._T[first:last, last : self.d] = C.T
        self._expanded, self.reached = first, last
        return self.d > last

    def ritz(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """theta (r,) descending, combinations S (r, r) of the vectors, and the residuals |A^-1 M x - theta x|_A (r,)."""
        theta, S = np.linalg.eigh(self.T)
        theta, S = theta[::-1], S[:, ::-1]
        return theta, S, np.linalg.norm(self.coupling @ S, axis=0)

    def closed(self) -> np.ndarray:
        """V M V' of all vectors (d, d), the last block included, which costs a product with M."""
        T = self._T[: self.d, : self.d].copy()
        last = slice(self.reached, self.d)
        T[:, last] = self.V @ self.operator.mass(self.V[last]).T
        T[last] = T[:, last].T
        return T

    def copy(self, more: int = 0) -> "Krylov":
        """Another one with the same vectors, which may grow by itself; with room for so many `more`."""
        other = Krylov(self.operator, min(self.d + more, max(self.n, self.d)))
        self._into(other)
        other._AV[: self.d] = self._AV[: self.d]
        return other

    def grown(self, more: int) -> "Krylov":
        """A copy that is to grow at once, as long as this one lives: products A V of vectors that both have are not copied."""
        other = Krylov(self.operator, min(self.d + more, max(self.n, self.d)), before=self._AV[: self.d])
        self._into(other)
        return other

    def _into(self, other: "Krylov") -> None:
        other.d, other.reached, other._expanded = self.d, self.reached, self._expanded
        other._T[: self.d, : self.d], other.known = self._T[: self.d, : self.d], self.known
        other._V[: self.d] = self.V

    def append(self, W: np.ndarray, R: np.ndarray, recent: int = 0) -> tuple[np.ndarray, np.ndarray]:
        """Add what is new in W (c, n), with R = A W: (h, C) so that W = h'V + C'V_new.

        First the vectors from `recent` on, those of the three-term recurrence, are taken out, then, as rounding leaves something
        of the others, all. Where little is left, W and A W have lost digits that they no longer share: W is solved for anew.
        """
        d, before = self.d, np.sqrt(np.maximum(np.einsum("ij,ij->i", W, R), 0.0))
        h = np.zeros((d, len(W)))
        for first in {recent: None, 0: None}:
            self._take_out(W, R, h, first)
        W, R, C, left = _orthonormal(W, R, before, self.n - d)
        if len(W) and (left < _DOUBTFUL or self.operator.refined):
            more = np.zeros((d, len(W)))
            for _ in range(2):
                W = self.operator.solve(R)
                self._take_out(W, R, more, 0)
            h += more @ C
        W, R, again, _ = _orthonormal(W, R, np.ones(len(W)), self.n - d)
        self._reserve(d + len(W))
        own = d - len(self._before)
        self._V[d : d + len(W)], self._AV[own : own + len(W)] = W, R
        self.d += len(W)
        return h, again @ C

    def _take_out(self, W: np.ndarray, R: np.ndarray, h: np.ndarray, first: int) -> None:
        """Orthogonalise W, with R = A W, to the vectors from `first` on, in place; h gathers what was taken."""
        near = slice(first, self.d)
        part = self._V[near] @ R.T
        W -= part.T @ self._V[near]
        old = max(len(self._before) - first, 0)
        if old:
            R -= part[:old].T @ self._before[first:]
        R -= part[old:].T @ self._AV[max(first - len(self._before), 0) : self.d - len(self._before)]
        h[near] += part

    def _reserve(self, count: int) -> None:
        room = len(self._T)
        if count > room:
            more = max(count, room + room // 2) - room
            self._V, self._AV = (np.vstack([rows, np.empty((more, self.n))]) for rows in (self._V, self._AV))
            # workspace keeps the shorter ones: rare
            self._T = np.pad(self._T, (0, more))


def _orthonormal(W: np.ndarray, R: np.ndarray, before: np.ndarray, most: int):
    """V with W = C'V, A V, C (c', c), and the least share left of the lengths `before` (c,).

    Directions that are rounding alone are left out, and all but the largest where `most` are possible.
    """
    gram = W @ R.T
    length = np.sqrt(np.maximum(gram.diagonal(), 0.0))
    share = length / np.maximum(before, np.finfo(float).tiny)
    scale = np.where(share > _NOTHING, length, np.inf)
    size, U = np.linalg.eigh((gram + gram.T) / 2 / np.outer(scale, scale))
    kept = np.flatnonzero(size > _DEPENDENT)[-most:] if most else []
    size, U = np.sqrt(size[kept]), U[:, kept]
    back = (U / size / scale[:, None]).T
    left = np.min(share[share > _NOTHING], initial=1.0) * np.min(size, initial=1.0)
    return back @ W, back @ R, (U * size).T * length, left
