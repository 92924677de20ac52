"""Which node and direction each degree of freedom of an imported model is."""

from dataclasses import dataclass

import numpy as np

from mouse_cli.model.arrays import freeze
from mouse_cli.model.geometry import DIRECTIONS, Geometry

SCALAR = -1  # direction of a degree of freedom that has none, such as a scalar point or a modal coordinate


@dataclass(frozen=True)
class DofMap:
    """node (n,): number of the node of each degree of freedom; direction (n,): index into DIRECTIONS, or SCALAR."""

    node: np.ndarray
    direction: np.ndarray

    def __post_init__(self) -> None:
        freeze(self, int, node=(len(self.node),), direction=(len(self.node),))

    def __len__(self) -> int:
        return len(self.node)

    def labels(self) -> tuple[str, ...]:
        """Names (n,) such as `12TY`; `12S` for a scalar.

        >>> DofMap([3, 12, 40], [0, 4, SCALAR]).labels()
        ('3TX', '12RY', '40S')
        """
        names = (*DIRECTIONS, "S")  # SCALAR, as index -1, is the last
        return tuple(f"{node}{names[d]}" for node, d in zip(self.node.tolist(), self.direction.tolist(), strict=True))

    def geometry(self, ids: np.ndarray, coordinates: np.ndarray) -> Geometry:
        """The nodes ids (k,) at coordinates (k, 3), and which of them each degree of freedom is on.

        A scalar, or a node that is not among `ids`, belongs to no node of the geometry.
        """
        order = np.argsort(ids)
        place = np.searchsorted(ids, self.node, sorter=order).clip(max=len(ids) - 1)
        found = (ids[order[place]] == self.node) & (self.direction >= 0)
        node = np.where(found, order[place], -1)
        return Geometry(ids, coordinates, node, np.maximum(self.direction, 0), np.zeros((0, 2), int))
