"""Matrices that pick rows: nearly all of B has one 1 or -1 in a row, and products with it are sums of blocks."""

import numpy as np

Index = slice | np.ndarray


def span(index: np.ndarray) -> Index:
    """Ascending neighbours as a slice, whose use copies nothing; others as they are."""
    if len(index) and (np.diff(index) == 1).all():
        return slice(int(index[0]), int(index[-1]) + 1)
    return index


class Pick:
    """A matrix (a, l); single: no row has more than one entry."""

    def __init__(self, matrix: np.ndarray):
        self.matrix = matrix
        filled = matrix != 0
        self.single = bool((filled.sum(axis=1) <= 1).all())
        if self.single:
            rows = np.flatnonzero(filled.any(axis=1))
            columns = filled[rows].argmax(axis=1) if len(rows) else np.zeros(0, int)
            self.weights = matrix[rows, columns]
            self.rows, self.columns = span(rows), span(columns)
            self.empty = not len(rows)


def block(Y: np.ndarray, rows: Index, columns: Index) -> np.ndarray:
    """Y[:, rows, columns], a view where both are slices."""
    if isinstance(rows, slice) or isinstance(columns, slice):
        return Y[:, rows][:, :, columns]
    return Y[:, rows[:, None], columns]


def add(total: np.ndarray, left: Pick, Y: np.ndarray, right: Pick, sign: float = 1.0) -> None:
    """total (f, a, b) += sign left Y right' for Y (f, l, r), left (a, l) and right (b, r)."""
    if not (left.single and right.single):
        total += sign * np.matmul(left.matrix, np.matmul(Y, right.matrix.T))
        return
    if left.empty or right.empty:
        return
    part = block(Y, left.columns, right.columns)
    weights = sign * left.weights[:, None] * right.weights
    if (weights != 1).any():
        part = -part if (weights == -1).all() else part * weights
    if isinstance(left.rows, slice) and isinstance(right.rows, slice):
        total[:, left.rows, right.rows] += part
    else:
        rows, columns = (np.arange(total.shape[k])[each] for k, each in ((1, left.rows), (2, right.rows)))
        total[:, rows[:, None], columns] += part


def diagonal(left: Pick, Y: np.ndarray, right: Pick) -> np.ndarray:
    """Diagonal (f, a) of |left| |Y| |right|'."""
    if not (left.single and right.single):
        return np.einsum("al,flr,ar->fa", np.abs(left.matrix), np.abs(Y), np.abs(right.matrix), optimize=True)
    found = np.zeros((len(Y), len(left.matrix)))
    if not left.empty and not right.empty:
        rows, here, there = (
            np.arange(count)[each]
            for count, each in (
                (len(left.matrix), left.rows),
                (Y.shape[1], left.columns),
                (Y.shape[2], right.columns),
            )
        )
        found[:, rows] = np.abs(Y[:, here, there] * (left.weights * right.weights))
    return found
