"""The baseline: the matrices that no parameter moves, what the degrees of freedom are called and where they are."""

from dataclasses import dataclass

import numpy as np

from mouse_cli.model.arrays import Matrix, freeze
from mouse_cli.model.geometry import Geometry


@dataclass(frozen=True)
class Structure:
    """K, M (n, n), symmetric; dense numpy or scipy.sparse; K in N/m, M in kg, or any units that make omega^2 in rad^2/s^2.

    They are the constant part: terms (listed elements that follow A among them) add to it, and whether it is dense decides
    whether the model is. C, D: viscous and structural damping (D the imaginary part of K), None where there is none.
    """

    K: Matrix
    M: Matrix
    labels: tuple[str, ...] = ()
    geometry: Geometry | None = None
    C: Matrix | None = None
    D: Matrix | None = None

    def __post_init__(self) -> None:
        n = self.K.shape[0]
        freeze(self, **dict.fromkeys("KMCD", (n, n)))
        object.__setattr__(self, "labels", tuple(self.labels) or tuple(str(i + 1) for i in range(n)))

    @property
    def n(self) -> int:
        """Number of degrees of freedom."""
        return self.K.shape[0]


@dataclass(frozen=True)
class ListedElements:
    """The e elements of K and M that may vary (group RS of a card deck), stiffness first; `row` <= `col`, from 0.

    An off-diagonal element stands for itself and its mirror image: both move together.
    """

    is_mass: np.ndarray
    row: np.ndarray
    col: np.ndarray

    def __post_init__(self) -> None:
        e = len(self.row)
        freeze(self, bool, is_mass=(e,))
        freeze(self, int, row=(e,), col=(e,))

    def __len__(self) -> int:
        return len(self.row)

    @classmethod
    def none(cls) -> "ListedElements":
        """No element: a model that only terms move."""
        return cls(np.zeros(0, bool), np.zeros(0, int), np.zeros(0, int))

    def labels(self) -> tuple[str, ...]:
        """Names as the report prints them, e.g. `k(1,2)` and `m(3,3)`."""
        return tuple(
            f"{'m' if mass else 'k'}({i + 1},{j + 1})"
            for mass, i, j in zip(self.is_mass, self.row, self.col, strict=True)
        )
