"""Where the degrees of freedom of a structure are: nodes, directions, and lines to draw it by."""

from dataclasses import dataclass

import numpy as np

from mouse_cli.model.arrays import freeze

DIRECTIONS = ("TX", "TY", "TZ", "RX", "RY", "RZ")  # translations, then rotations, about the global axes


@dataclass(frozen=True)
class Geometry:
    """k nodes and the n degrees of freedom on them.

    node_ids (k,), as the deck names them; coordinates (k, 3) in m. node (n,): index into node_ids of each degree of freedom, -1
    where it belongs to no node; direction (n,): index into DIRECTIONS. lines (l, 2): pairs of node indices that elements join.
    """

    node_ids: np.ndarray
    coordinates: np.ndarray
    node: np.ndarray
    direction: np.ndarray
    lines: np.ndarray

    def __post_init__(self) -> None:
        k, n, l = len(self.node_ids), len(self.node), len(self.lines)
        freeze(self, int, node_ids=(k,), node=(n,), direction=(n,), lines=(l, 2))
        freeze(self, coordinates=(k, 3))

    @property
    def placed(self) -> np.ndarray:
        """Mask (n,) of the degrees of freedom that are sites: those of nodes, without what solvers add; all where none is."""
        own = self.node >= 0
        return own | ~own.any()

    def labels(self) -> tuple[str, ...]:
        """Names (n,) of the degrees of freedom: node, then direction, such as `12TY`; a number where there is no node."""
        named = zip(self.node.tolist(), self.direction.tolist(), strict=True)
        return tuple(
            str(i) if node < 0 else f"{self.node_ids[node]}{DIRECTIONS[d]}" for i, (node, d) in enumerate(named, 1)
        )


def rigid_motions(x: np.ndarray, direction: np.ndarray, small: float) -> np.ndarray:
    """Motion (k, 6) of degrees of freedom at places x (k, 3), from the centre, in `direction` (k,), of a rigid body.

    Rotations move a translation by its arm, or, with an arm of at most `small`, not at all.
    """
    pattern = np.eye(6)[direction]
    arms = np.cross(np.eye(3)[:, None], x[None]).transpose(1, 2, 0)  # (k, 3 of the place, 3 of the rotation)
    moved = direction < 3
    pattern[moved, 3:] = arms[moved, direction[moved]]
    pattern[moved, 3:] *= np.abs(pattern[moved, 3:]) > small
    return pattern
