"""A parameterised contribution to the equations of motion: what an element library, a group matrix or a column of A is made of."""

from dataclasses import dataclass
from typing import Protocol

import numpy as np

from mouse_cli.model.arrays import freeze

MATRICES = ("K", "M", "C", "D")  # stiffness, mass, viscous damping, structural damping (imaginary part of K)


@dataclass(frozen=True)
class Places:
    """Where a term stands in a matrix: z entries (row, col), from 0, mirror images included; entries of one place add up.

    A term whose matrices stand in the same places gives the same object for them: it is worked through once.
    """

    row: np.ndarray
    col: np.ndarray

    def __post_init__(self) -> None:
        z = len(self.row)  # up to 1e8 of them: 32 bits each
        freeze(self, np.int32, row=(z,), col=(z,))

    def __len__(self) -> int:
        return len(self.row)


@dataclass(frozen=True)
class Slopes:
    """First derivatives of a matrix: d(matrix[row, col]) / d(theta[parameter]) = value, z entries, mirror images included.

    Entries of one place and parameter add up. All counted from 0; theta in the units of the parameters, not their logarithms.
    """

    parameter: np.ndarray
    row: np.ndarray
    col: np.ndarray
    value: np.ndarray

    def __len__(self) -> int:
        return len(self.value)


CONSTANT = Slopes(np.zeros(0, int), np.zeros(0, int), np.zeros(0, int), np.zeros(0))


class Term(Protocol):
    """What every kind of term offers; theta (p,) are the values of all parameters of the deck, in their units.

    places: for each of MATRICES in which the term stands, where (the same for every theta). linear: whether values are linear
    in theta, so that slopes are the same for every theta.
    """

    places: dict[str, Places]
    linear: bool

    def values(self, theta: np.ndarray) -> dict[str, np.ndarray]:
        """For each matrix of `places`, the values (z,) at theta (p,)."""
        ...

    def slopes(self, theta: np.ndarray) -> dict[str, Slopes]:
        """First derivatives at theta, for each matrix that moves."""
        ...
