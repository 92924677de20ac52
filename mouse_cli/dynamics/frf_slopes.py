"""Derivatives of frequency response functions by parameters of K, M, C and D (lecture 21 on modal testing, FRF sensitivities):

    d alpha/dp = -alpha (dZ/dp) alpha,    dZ/dp = dK/dp + i dD/dp + s dC/dp + s^2 dM/dp

The motions at all lines span few directions, many fewer than there are lines; dK/dp and the others are projected on these once.
"""

from collections.abc import Iterator

import numpy as np

from mouse_cli.dynamics.frf import Fields
from mouse_cli.model.arrays import Matrix
from mouse_cli.model.term import CONSTANT, MATRICES, Slopes

_SPAN = 1e-6  # directions in which no motion has more than this share of its length are left out
_AT_ONCE = 3_000_000  # complex numbers worked on at once


class Change:
    """dK_j, dM_j, dC_j, dD_j of p parameters as sparse rows: row by row of those that are not zero, parameter under parameter."""

    def __init__(self, n: int, p: int, slopes: dict[str, Slopes]):
        self.n, self.p = n, p
        self.parts = {name: _Rows(n, p, slopes[name]) for name in MATRICES if len(slopes.get(name, CONSTANT))}

    def projected(self, V: np.ndarray) -> dict[str, np.ndarray]:
        """V dK_j V' and so on (p, r, r), for rows V (r, n)."""
        return {name: part.projected(V) for name, part in self.parts.items()}


class _Rows:
    """One matrix: `matrix` (t, n) holds the rows; row (t,) degree of freedom of each; start (p + 1,): where each begins."""

    def __init__(self, n: int, p: int, slopes: Slopes):
        keys = slopes.parameter.astype(np.int64) * n + slopes.row
        present, place = np.unique(keys, return_inverse=True)
        self.row = (present % n).astype(int)
        self.start = np.searchsorted(present, np.arange(p + 1, dtype=np.int64) * n)
        self.p, self._place, self._slopes = p, place, slopes
        self.matrix = _sparse(slopes, place, len(present), n) if n > 200 else None

    def projected(self, V: np.ndarray) -> np.ndarray:
        r = len(V)
        columns = np.ascontiguousarray(V.T)
        out = np.zeros((self.p, r, r))
        for j in range(self.p):
            rows = slice(self.start[j], self.start[j + 1])
            if rows.start < rows.stop:
                out[j] = columns[self.row[rows]].T @ self._forces(rows, columns)
        return out

    def _forces(self, rows: slice, columns: np.ndarray) -> np.ndarray:
        """Those rows times `columns` (n, r)."""
        if self.matrix is not None:
            return self.matrix[rows] @ columns
        own = (self._place >= rows.start) & (self._place < rows.stop)
        force = np.zeros((rows.stop - rows.start, columns.shape[1]))
        np.add.at(force, self._place[own] - rows.start, self._slopes.value[own, None] * columns[self._slopes.col[own]])
        return force


def _sparse(slopes: Slopes, place: np.ndarray, t: int, n: int) -> Matrix:
    from scipy.sparse import coo_array

    return coo_array((slopes.value, (place, slopes.col)), shape=(t, n)).tocsr()


def slopes(fields: Fields, change: Change, left: int = 0, right: int = 1) -> Iterator[tuple[slice, np.ndarray]]:
    """-Y_left' (dZ/dp) Y_right (f, o, i, p') for the parameters of one slice after the other."""
    Y_left, Y_right, V = _spanned(fields, left, right)
    projected = change.projected(V)
    f, r, i = Y_right.shape
    flat = np.moveaxis(Y_right, 1, 0).reshape(r, f * i)
    flat = np.concatenate([flat.real, flat.imag], axis=1)
    back = np.ascontiguousarray(np.swapaxes(Y_left, 1, 2))
    weights = {"K": np.ones(f), "M": fields.s**2, "C": fields.s, "D": np.full(f, 1j)}
    each = max(1, _AT_ONCE // (r * f * i))
    for first in range(0, change.p, each):
        part = slice(first, min(first + each, change.p))
        force = np.zeros((f, r, part.stop - part.start, i), complex)
        for name, B in projected.items():
            own = B[part]
            if own.any():
                moved = own.reshape(-1, r) @ flat
                moved = (moved[:, : f * i] + 1j * moved[:, f * i :]).reshape(-1, r, f, i)
                force -= weights[name][:, None, None, None] * np.transpose(moved, (2, 1, 0, 3))
        out = np.matmul(back, force.reshape(f, r, -1)).reshape(f, -1, part.stop - part.start, i)
        yield part, np.moveaxis(out, 2, 3)


def _spanned(fields: Fields, left: int, right: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """The motions of both sets by the few directions they have together, and those directions V (r, n)."""
    parts = [fields.of(left), fields.of(right)]
    V, d = fields.model.V, fields.model.d
    if V is None:
        return *parts, np.eye(d)
    columns = np.concatenate([np.moveaxis(Y, 1, 0).reshape(d, -1) for Y in parts], axis=1)
    size = np.linalg.norm(columns, axis=0)
    columns = columns / np.where(size > 0, size, 1.0)
    real = np.concatenate([columns.real, columns.imag], axis=1)
    w, U = np.linalg.eigh(real @ real.T)
    U = U[:, w > _SPAN**2 * w[-1]]
    return *(np.matmul(U.T, Y) for Y in parts), U.T @ V
