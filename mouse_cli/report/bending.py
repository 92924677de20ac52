"""Points along the beams of a structure of few nodes, so that a drawing bends where the structure does."""

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from mouse_cli.model.mesh import Mesh

FEW, _BETWEEN = 10, 5  # beams up to which points lie along them, and how many along each
_BENT = ("beam", "cracked_beam")


@dataclass(frozen=True)
class Bent:
    """Points along b beams from node a to node b: ids, a, b (b,); xi (r,): how far along; span (b, 3): from a to b."""

    ids: np.ndarray
    a: np.ndarray
    b: np.ndarray
    xi: np.ndarray
    span: np.ndarray

    def at(self, of_nodes: np.ndarray) -> np.ndarray:
        """Points (b r, 3) between the positions (k, 3) of the nodes, one beam after another."""
        a, b, xi = of_nodes[self.a][:, None], of_nodes[self.b][:, None], self.xi[:, None]
        return ((1 - xi) * a + xi * b).reshape(-1, 3)

    def moved(self, u: np.ndarray) -> np.ndarray:
        """Displacements (b r, 3) of the points by those of the nodes (k, 6), rotations last.

        Along the beam linear, across it the cubic with u' = theta x e at both ends (Przemieniecki 1968, ch. 5).
        """
        length = np.linalg.norm(self.span, axis=1, keepdims=True)
        e = (self.span / length)[:, None]
        across = lambda v: v - (v * e).sum(axis=2, keepdims=True) * e
        ends = [u[node, None, :3] for node in (self.a, self.b)]
        slopes = [np.cross(u[node, 3:], self.span)[:, None] for node in (self.a, self.b)]
        xi = self.xi[:, None]
        straight = (1 - xi) * ends[0] + xi * ends[1]
        cubic = (1 - 3 * xi**2 + 2 * xi**3) * ends[0] + (3 * xi**2 - 2 * xi**3) * ends[1]
        cubic = cubic + xi * (1 - xi) ** 2 * slopes[0] - xi**2 * (1 - xi) * slopes[1]
        return (straight - across(straight) + across(cubic)).reshape(-1, 3)

    def through(self, first: int) -> dict[int, list[int]]:
        """By id of a beam the points that it goes through, its nodes first and last; `first`: index of the first point between."""
        r, pairs = len(self.xi), zip(self.ids.tolist(), self.a.tolist(), self.b.tolist(), strict=True)
        return {i: [a, *range(first + r * k, first + r * (k + 1)), b] for k, (i, a, b) in enumerate(pairs)}

    def lines(self, lines: np.ndarray, first: int) -> np.ndarray:
        """`lines` (l, 2) with each beam as a line through its points."""
        beams = {(min(a, b), max(a, b)) for a, b in zip(self.a.tolist(), self.b.tolist(), strict=True)}
        found = [line for line in lines.tolist() if tuple(line) not in beams]
        for points in self.through(first).values():
            found += [list(pair) for pair in pairwise(points)]
        return np.array(found, int).reshape(-1, 2)


def bent(mesh: Mesh | None) -> Bent | None:
    """The beams of `mesh` that pass on bending at both ends; None where there are none, or more than FEW."""
    sets = () if mesh is None else [s for s in mesh.elements if s.type in _BENT and not s.options.get("releases")]
    sets = [s for s in sets if not s.options.get("offsets")]
    if not 0 < sum(map(len, sets)) <= FEW:
        return None
    ids = np.concatenate([s.ids for s in sets])
    a, b = (np.concatenate([s.nodes[:, end] for s in sets]) for end in (0, -1))
    xi = np.arange(1, _BETWEEN + 1) / (_BETWEEN + 1)
    return Bent(ids, a, b, xi, mesh.coordinates[b] - mesh.coordinates[a])
