"""One subspace for the adjoint solutions of all modes: (I - mu_i A^-1 M) W_i = A^-1 L has one Krylov space for every mode i.

W_i = G_i L, what unit loads L (n, s) at the sensors do to mode i, follows by Galerkin's method from V = [Q, U_0, ..., U_K]:

    W_i = sum_k r_k (r_k'L) / (1 - mu_i theta_k)

over Ritz pairs theta_k, r_k of A^-1 M in V, those of the cluster of i left out.

Q is the space that the modes were found in, A-orthonormal; U_0 holds what A^-1 L has outside of it, and the residual block of
Q, without which accuracy ends at 1e-3; U_k = T_k(X) U_0 with Chebyshev polynomials of X = (P A^-1 M P - c) / h, P the projector
that removes Q. The Gram matrices come from moments of the polynomials, two products of block with block a level.
"""

from typing import Protocol

import numpy as np

from mouse_cli.dynamics.contraction import rows_of
from mouse_cli.dynamics.krylov import Krylov
from mouse_cli.dynamics.sensing import unit_loads
from mouse_cli.model.arrays import Matrix

_DEPENDENT = 1e-10  # share of a scaled Gram matrix below which a direction is lost in the rounding of the moments
_NOTHING = 1e-13  # share of the square of a column's length that is rounding when Q is taken out
COLUMNS, ROWS = 32, 2048  # worked on at once: right-hand sides; rows, which then stay in the cache
_ABOVE = 1.05  # the Chebyshev interval ends so much above the largest eigenvalue seen


class AdjointSpace(Protocol):
    """A basis V (n, d) that grows level by level. loads (d, s): V'L."""

    loads: np.ndarray
    krylov: Krylov

    def extend(self) -> None:
        """One level more."""
        ...

    def ritz(self, level: int) -> tuple[np.ndarray, np.ndarray]:
        """theta (r,), descending, and Ritz vectors in terms of the basis (d', r), for the levels up to `level`."""
        ...

    def overlap(self, level: int) -> np.ndarray:
        """X'M V (k, d') of the known modes X, where rounding has to be taken out."""
        ...

    def rows(self, at: np.ndarray) -> list[np.ndarray]:
        """V at the degrees of freedom `at` (r,), as parts (r, d_1), (r, d_2), ... of the basis."""
        ...


class ChebyshevSpace:
    """Levels by the Chebyshev recurrence, without orthogonalisation: cheap, with a floor of 1e-8 to 1e-7."""

    def __init__(self, krylov: Krylov, sensing: Matrix):
        self.krylov, self._operator = krylov, krylov.operator
        self._at, self._values = unit_loads(sensing)
        self._Q, rest = krylov.V[: krylov.reached], krylov.V[krylov.reached :]
        self._s = s = self._values.shape[1]
        self._U: list[np.ndarray] = []
        first = self._block(s + len(rest))
        for columns in _cut(s, COLUMNS):
            L = np.zeros((krylov.n, columns.stop - columns.start), order="F")
            L[self._at] = self._values[:, columns]
            first[:, columns] = self._operator.columns(L)
        first[:, s:] = rest.T
        in_Q = self._Q[:, self._at] @ self._values
        for rows in _cut(krylov.n, ROWS):
            first[rows, :s] -= self._Q[:, rows].T @ in_Q
        if krylov.known is not None:
            krylov.known.take_out(first)
        a0 = np.eye(s + len(rest))  # U_0'A U_0 = U_0'L, as both parts of it are orthogonal to Q
        a0[:, :s] = first[self._at].T @ self._values
        a0[:s, s:] = a0[s:, :s].T
        a0[:s, :s] = (a0[:s, :s] + a0[:s, :s].T) / 2
        self.loads = np.vstack([in_Q, a0[:, :s]])
        self._least = np.zeros(len(a0))
        self._least[:s] = _NOTHING * (np.einsum("ij,ij->j", in_Q, in_Q) + a0.diagonal()[:s])
        self._a, self._N = [a0], []
        self._N = [sum(first[rows].T @ (rows_of(krylov.operator.M, rows) @ first) for rows in _cut(krylov.n, ROWS))]
        self._half = self._centre = 1.0  # until there is a second block to tell from

    def _block(self, columns: int) -> np.ndarray:
        """Memory (n, columns) for the next level."""
        self._U.append(self.krylov.workspace.array(f"U{len(self._U)}", (self.krylov.n, columns)))
        return self._U[-1]

    def _products(self) -> tuple[np.ndarray, np.ndarray]:
        """U_k-1'M U_k and U_k'M U_k by the newest U_k."""
        near, own = np.zeros(self._a[0].shape), np.zeros(self._a[0].shape)
        for rows in _cut(self.krylov.n, ROWS):
            MU = rows_of(self._operator.M, rows) @ self._U[-1]
            near += self._U[-2][rows].T @ MU
            own += self._U[-1][rows].T @ MU
        return near, own

    def extend(self) -> None:
        level = len(self._U)
        before, image = self._U[-1], self._image(level)
        near, own = self._spanned() if level == 1 else (None, None)
        c, h = self._centre, self._half
        for rows in _cut(self.krylov.n, ROWS):
            part = image[rows]
            part -= c * before[rows]
            part *= (1 if level == 1 else 2) / h
            if level > 1:
                part -= self._U[-3][rows]
        self.loads = np.vstack([self.loads, image[self._at].T @ self._values])
        if level == 1:
            self._N = [self._N[0], near]
        else:
            near, own = self._products()
            self._N.append(2 * near - self._N[1])
        self._N.append(2 * own - self._N[0])
        while len(self._a) < len(self._N):  # N_l = c a_l + h (a_l+1 + a_|l-1|) / 2, a_l = U_0'A T_l(X) U_0
            l = len(self._a) - 1
            new = (self._N[l] - c * self._a[l]) / h
            self._a.append(new if l == 0 else 2 * new - self._a[l - 1])

    def _image(self, level: int) -> np.ndarray:
        """P A^-1 M U (n, c) of the newest U, as the next one."""
        before = self._U[-1]
        image, in_Q = self._block(before.shape[1]), self._in_Q(0)
        for columns in _cut(before.shape[1], COLUMNS):
            R = self._operator.M @ np.ascontiguousarray(before[:, columns])
            if level > 1:  # rounding has crept in, which the polynomials would blow up
                in_Q[:, columns] = self._Q @ R
            image[:, columns] = self._operator.columns(np.asfortranarray(R))
        near = self.krylov.last_reached if level == 1 else slice(0, len(self._Q))
        for rows in _cut(self.krylov.n, ROWS):
            image[rows] -= self._Q[near, rows].T @ in_Q[near]
        if self.krylov.known is not None:
            self.krylov.known.take_out(image)
        return image

    def _spanned(self) -> tuple[np.ndarray, np.ndarray]:
        """Moments by T_1(X) U_0 in place of P A^-1 M U_0, once the interval ends above the largest eigenvalue seen in both."""
        (near, own), a0, N0 = self._products(), self._a[0], self._N[0]
        stiff, mass = np.block([[a0, N0], [N0, near]]), np.block([[N0, near], [near.T, own]])
        Z = _whitening((stiff + stiff.T) / 2, np.tile(self._least, 2))
        self._half = self._centre = c = _ABOVE / 2 * _largest(mass, Z)
        return (near - c * N0) / c, (own - c * (near + near.T) + c**2 * N0) / c**2

    def _in_Q(self, level: int) -> np.ndarray:
        """Q'M U_level (D, c): A^-1 M Q leaves Q only through its residual block, which is part of U_0."""
        return self.krylov.coupling.T @ self._a[level][self._s :]

    def ritz(self, level: int) -> tuple[np.ndarray, np.ndarray]:
        stiff, mass = (self._gram(moments, level) for moments in (self._a, self._N))
        Z = _whitening(stiff, np.tile(self._least, level + 1))
        cross = np.hstack([self._in_Q(k) for k in range(level + 1)]) @ Z
        T = self.krylov.T
        theta, S = np.linalg.eigh(np.block([[T, cross], [cross.T, Z.T @ mass @ Z]]))
        return theta[::-1], np.vstack([S[: len(T)], Z @ S[len(T) :]])[:, ::-1]

    def _gram(self, moments: list[np.ndarray], level: int) -> np.ndarray:
        """U_a' (A or M) U_b = (moment a + b plus moment |a - b|) / 2 for all a, b up to `level`."""
        each = range(level + 1)
        G = np.block([[(moments[a + b] + moments[abs(a - b)]) / 2 for b in each] for a in each])
        return (G + G.T) / 2

    def overlap(self, level: int) -> np.ndarray:
        MX = self.krylov.known.MX
        return np.hstack([MX @ self._Q.T, *(MX @ U for U in self._U[: level + 1])])

    def rows(self, at: np.ndarray) -> list[np.ndarray]:
        return [np.take(self._Q, at, axis=1).T, *(U[at] for U in self._U)]


class OrthonormalSpace:
    """Levels by block Lanczos with full orthogonalisation: exact to rounding, about twice as dear."""

    def __init__(self, krylov: Krylov, sensing: Matrix):
        self.krylov = krylov.copy()
        self._at, self._values = unit_loads(sensing)
        L = np.zeros((self._values.shape[1], krylov.n))
        L[:, self._at] = self._values.T
        self.krylov.append(krylov.operator.solve(L), L)
        self._levels = [self.krylov.d]
        self._closed()

    def _closed(self) -> None:
        """Galerkin's matrix and loads with the last block included."""
        self._T = self.krylov.closed()
        self.loads = self.krylov.V[:, self._at] @ self._values

    def extend(self) -> None:
        self.krylov.expand()
        self._levels.append(self.krylov.d)
        self._closed()

    def ritz(self, level: int) -> tuple[np.ndarray, np.ndarray]:
        d = self._levels[level]
        theta, S = np.linalg.eigh(self._T[:d, :d])
        return theta[::-1], S[:, ::-1]

    def overlap(self, level: int) -> np.ndarray:
        return self.krylov.known.MX @ self.krylov.V[: self._levels[level]].T

    def rows(self, at: np.ndarray) -> list[np.ndarray]:
        return [np.take(self.krylov.V, at, axis=1).T]


def _whitening(gram: np.ndarray, least: np.ndarray) -> np.ndarray:
    """Z with Z' gram Z = I, without what is rounding: directions no longer than `least` squared, or nearly dependent."""
    own = gram.diagonal() > least
    scale = np.where(own, 1 / np.sqrt(np.where(own, gram.diagonal(), 1.0)), 0.0)
    size, Z = np.linalg.eigh(gram * scale[:, None] * scale)
    kept = size > _DEPENDENT
    return scale[:, None] * Z[:, kept] / np.sqrt(size[kept])


def _largest(N: np.ndarray, Z: np.ndarray) -> float:
    """Largest eigenvalue of N in the directions Z; 1 where there are none."""
    return float(np.linalg.eigvalsh(Z.T @ (N + N.T) @ Z / 2)[-1]) if Z.shape[1] else 1.0


def _cut(length: int, each: int) -> list[slice]:
    return [slice(i, min(i + each, length)) for i in range(0, length, each)]
