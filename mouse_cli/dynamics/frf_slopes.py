"""Derivatives of frequency response functions by parameters of K, M, C and D (lecture 21 on modal testing, FRF sensitivities):

    d alpha/dp = -alpha (dZ/dp) alpha,    dZ/dp = dK/dp + i dD/dp + s dC/dp + s^2 dM/dp

The motions at all lines span few directions, many fewer than there are lines; dK/dp and the others are projected on these once.
"""

from collections.abc import Iterator
from functools import cached_property

import numpy as np

from mouse_cli.dynamics.contraction import Stack, rows_of
from mouse_cli.dynamics.frf import Fields
from mouse_cli.model.arrays import Matrix
from mouse_cli.model.term import CONSTANT, MATRICES, Slopes

_SPAN = 1e-6  # directions in which no motion has more than this share of its length are left out
_SMALL = 60  # degrees of freedom up to which derivatives are formed as dense matrices
_ROWS = 100_000  # of derivatives, worked on at once
_AT_ONCE = 1_000_000  # complex numbers worked on at once: fresh pages for more cost more than what is computed in them


class Change:
    """dK_j, dM_j, dC_j, dD_j of p parameters, from their entries; as sparse rows where the model is large."""

    def __init__(self, n: int, p: int, slopes: dict[str, Slopes]):
        self.n, self.p = n, p
        self._slopes = {name: slopes[name] for name in MATRICES if len(slopes.get(name, CONSTANT))}

    @cached_property
    def _stacks(self) -> dict[tuple[str, str], Stack]:
        """K with M and C with D, row under row; Stack knows two matrices by the names of the first pair."""
        found = {}
        for pair in (("K", "M"), ("C", "D")):
            own = {of: self._slopes[name] for of, name in zip(("K", "M"), pair, strict=True) if name in self._slopes}
            if own:
                found[pair] = Stack(self.n, self.p, own)
        return found

    def projected(self, V: np.ndarray) -> dict[str, np.ndarray]:
        """V dK_j V' and so on (p, r, r), for rows V (r, n)."""
        columns = np.ascontiguousarray(V.T)
        if self.n <= _SMALL:
            return {name: _small(part, self.p, columns) for name, part in self._slopes.items()}
        found = {}
        for pair, stack in self._stacks.items():
            for name, matrix in zip(pair, (stack.K, stack.M), strict=True):
                if name in self._slopes:
                    found[name] = _of_rows(stack, matrix, columns)
        return found


def _small(slopes: Slopes, p: int, columns: np.ndarray) -> np.ndarray:
    """V dA_j V' (p, r, r), entry by entry."""
    n = len(columns)
    dA = np.bincount((slopes.parameter * n + slopes.row) * n + slopes.col, slopes.value, minlength=p * n * n)
    return columns.T @ (dA.reshape(p, n, n) @ columns)


def _of_rows(stack: Stack, matrix: Matrix, columns: np.ndarray) -> np.ndarray:
    """V dA_j V' (p, r, r), some parameters at a time."""
    out = np.zeros((stack.p, columns.shape[1], columns.shape[1]))
    for first, last in stack.chunks(_ROWS, stack.p):
        start = stack.start[first : last + 1]
        force = rows_of(matrix, slice(start[0], start[-1])) @ columns
        for j in range(first, last):
            at = slice(stack.start[j], stack.start[j + 1])
            if at.start < at.stop:
                out[j] = columns[stack.rows[at]].T @ force[at.start - start[0] : at.stop - start[0]]
    return out


def slopes(fields: Fields, change: Change, left: int = 0, right: int = 1) -> Iterator[tuple[slice, np.ndarray]]:
    """d alpha/dp = -Y_left' (dZ/dp) Y_right (f, o, i, p') for the parameters of one slice after the other."""
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
    gram, lines = np.zeros((d, d)), max(1, _AT_ONCE // (4 * d * fields.Y.shape[2]))
    for first in range(0, len(fields.s), lines):
        for Y in parts:
            columns = np.moveaxis(Y[first : first + lines], 1, 0).reshape(d, -1)
            size = np.linalg.norm(columns, axis=0)
            columns = columns / np.where(size > 0, size, 1.0)
            gram += columns.real @ columns.real.T + columns.imag @ columns.imag.T
    w, U = np.linalg.eigh(gram)
    U = U[:, w > _SPAN**2 * w[-1]]
    return *(np.matmul(U.T, Y) for Y in parts), U.T @ V
