"""Receptances of a model in its modes, with losses of low rank beside a diagonal dynamic stiffness.

Z = Z_0 + G' W(s) G, with Z_0 diagonal. Between any rows R and C of motion R Z_0^-1 C' is a sum over modes, one product of real
matrices for all lines; what the losses make of it is a system of as many equations as G has rows, line by line:

    Z^-1 = Z_0^-1 - Z_0^-1 G' (I + W G Z_0^-1 G')^-1 W G Z_0^-1

(Sherman, Morrison and Woodbury). Responses at all coordinates are made for the forces alone, which are few, and for sensors only
where losses have more rows than there are sensors.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np


@dataclass(frozen=True)
class Receptance:
    """Z^-1 at f lines. outputs (o, n), inputs (i, n): motion of each mode that is read, and that forces act on; rows G (c, n).

    flat (n, f) = Z_0^-1; W (f, c, c): cores of the losses.
    """

    outputs: np.ndarray
    inputs: np.ndarray
    rows: np.ndarray
    flat: np.ndarray
    W: np.ndarray

    @cached_property
    def H(self) -> np.ndarray:
        """S Z^-1 B' (f, o, i)."""
        o, i = len(self.outputs), len(self.inputs)
        found = self._elastic
        return found[:, :o, :i] - self._lost @ found[:, o:, :i]

    @cached_property
    def right(self) -> np.ndarray:
        """Z^-1 B' (n, f, i)."""
        found = np.broadcast_to(self.inputs.T[:, None], (len(self.flat), len(self.W), len(self.inputs)))
        if len(self.rows):
            back = self._core @ self._elastic[:, len(self.outputs) :, : len(self.inputs)]
            found = found - times(self.rows.T, np.swapaxes(back, 0, 1))
        return self.flat[:, :, None] * found

    def read(self, forces: np.ndarray) -> np.ndarray:
        """S Z^-1 F (o, ..., f, i) for forces F (n, ..., f, i) on modes."""
        flat = self.flat[(slice(None), *[None] * (forces.ndim - 3), slice(None), None)]
        found = times(np.concatenate([self.outputs, self.rows]), flat * forces)
        found, felt = found[: len(self.outputs)], found[len(self.outputs) :]
        if not len(self.rows):
            return found
        by_line = np.moveaxis(felt, -2, 0)  # (f, c, ..., i)
        lost = self._lost @ by_line.reshape(*by_line.shape[:2], -1)
        return found - np.moveaxis(lost.reshape(len(lost), len(found), *by_line.shape[2:]), 0, -2)

    def left(self, count: int) -> np.ndarray:
        """S Z^-1 (o, count, f) of forces on the first modes."""
        lost = times(self.rows[:, :count].T, np.swapaxes(self._lost, 0, 2))  # (count, o, f)
        return (self.outputs[:, :count, None] - np.swapaxes(lost, 0, 1)) * self.flat[:count]

    def across(self, rows: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """S Z^-1 R' (f, o, a) and R Z^-1 B' (f, a, i) of rows R (a, n)."""
        right = np.swapaxes(times(rows, self.right), 0, 1)
        if len(rows) > len(self.outputs):
            return np.transpose(times(rows, self._every), (2, 1, 0)), right
        forces = np.broadcast_to(rows.T[:, None], (len(self.flat), len(self.W), len(rows)))
        return np.swapaxes(self.read(forces), 0, 1), right

    @cached_property
    def _every(self) -> np.ndarray:
        """S Z^-1 (n, o, f)."""
        return np.swapaxes(self.left(len(self.flat)), 0, 1)

    @cached_property
    def _elastic(self) -> np.ndarray:
        """Z_0^-1 (f, o + c, i + c) between what is read, or what the losses act in, and what is driven, or these."""
        one, other = (np.concatenate([each, self.rows]) for each in (self.outputs, self.inputs))
        both = (one[:, None] * other).reshape(-1, len(self.flat))
        return np.ascontiguousarray(times(both, self.flat).T).reshape(-1, len(one), len(other))

    @cached_property
    def _core(self) -> np.ndarray:
        """(I + W G Z_0^-1 G')^-1 W (f, c, c)."""
        between = self._elastic[:, len(self.outputs) :, len(self.inputs) :]
        return np.linalg.solve(np.eye(len(self.rows)) + self.W @ between, self.W)

    @cached_property
    def _lost(self) -> np.ndarray:
        """S Z_0^-1 G' (I + W G Z_0^-1 G')^-1 W (f, o, c)."""
        return self._elastic[:, : len(self.outputs), len(self.inputs) :] @ self._core


def times(matrix: np.ndarray, values: np.ndarray) -> np.ndarray:
    """Real matrix (a, n) times complex values (n, ...): (a, ...), by a product of real matrices."""
    flat = np.ascontiguousarray(values, complex).reshape(matrix.shape[1], int(np.prod(values.shape[1:])))
    return (matrix @ flat.view(float)).view(complex).reshape(len(matrix), *values.shape[1:])
