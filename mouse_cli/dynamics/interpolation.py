"""How a point of a structure moves: the three translations and rotations there, from the degrees of freedom around it."""

from dataclasses import dataclass
from typing import Protocol

import numpy as np

from mouse_cli.model.geometry import Geometry

_NEIGHBOURS = 8  # nodes from which a point of a cloud without lines is interpolated


class Following(Protocol):
    """How nodes move that follow others over rigid links."""

    def of(self, node: int, direction: int) -> tuple[np.ndarray, np.ndarray]:
        """Degrees of freedom (from 0) and factors that make up the motion of a node (index); empty where it cannot move."""


@dataclass(frozen=True)
class PointMotion:
    """weights (6, d): TX, TY, TZ, RX, RY, RZ of a point by the degrees of freedom `dofs` (d,), from 0.

    distance: from the point to what it was interpolated on, in m; reach: the size of that, in m. node: the nearest node (index).
    """

    dofs: np.ndarray
    weights: np.ndarray
    distance: float
    reach: float
    node: int

    def along(self, direction: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Degrees of freedom (r,) and their weights (r,) in the reading of a sensor with `direction` (6,), without zeros."""
        weights = direction @ self.weights
        kept = np.abs(weights) > 1e-12 * max(1.0, np.abs(weights).max(initial=0.0))
        return self.dofs[kept], weights[kept]


def at_node(geometry: Geometry, node: int, follows: Following | None = None) -> PointMotion:
    """The motion of a node (index); what cannot move there has no weight. follows: None where no node follows another."""
    return _motion(_Free(geometry) if follows is None else follows, [node], [np.eye(6)], 0.0, 0.0, node)


def at_point(geometry: Geometry, point: np.ndarray, follows: Following | None = None) -> PointMotion:
    """The motion of `point` (3,): on the nearest line of the geometry where there are lines, else among the nearest nodes.

    On a line from a to b whose nodes rotate the deflection across it is the cubic of a beam, u' = theta x e (Przemieniecki 1968,
    ch. 5), that along it and the twist are linear; a point beside the line moves with the cross-section, u + theta x r. On a line
    whose nodes do not rotate all is linear. In a cloud of nodes it is the linear field that fits the 8 nearest nodes,
    near ones counting most: exact for rigid-body motion and uniform strain.
    """
    nearest = int(np.argmin(np.sum((geometry.coordinates - point) ** 2, axis=1)))
    follows = _Free(geometry) if follows is None else follows
    on = _on_line if len(geometry.lines) else _among_nodes
    return on(geometry, point, nearest, follows)


@dataclass(frozen=True)
class _Free:
    """Nodes that follow no other: each direction is a degree of freedom, or held."""

    geometry: Geometry

    def of(self, node: int, direction: int) -> tuple[np.ndarray, np.ndarray]:
        """The degree of freedom of a direction."""
        dofs = np.flatnonzero((self.geometry.node == node) & (self.geometry.direction == direction))
        return dofs, np.ones(len(dofs))


def _on_line(geometry: Geometry, point: np.ndarray, nearest: int, follows: Following) -> PointMotion:
    a, b = (geometry.coordinates[geometry.lines[:, end]] for end in (0, 1))
    span = b - a
    length2 = np.maximum(np.einsum("ij,ij->i", span, span), np.finfo(float).tiny)
    xi = np.clip(np.einsum("ij,ij->i", point - a, span) / length2, 0.0, 1.0)
    offset = point - (a + xi[:, None] * span)
    line = int(np.argmin(np.einsum("ij,ij->i", offset, offset)))
    ends, length = geometry.lines[line], float(np.sqrt(length2[line]))
    rotates = any(len(follows.of(end, d)[0]) for end in ends for d in (3, 4, 5))
    parts = _beam(xi[line], span[line] / length, length, offset[line]) if rotates else _bar(xi[line])
    return _motion(follows, ends, parts, float(np.linalg.norm(offset[line])), length, nearest)


def _bar(xi: float) -> list[np.ndarray]:
    """Motion of a point of a line by that of its ends, (6, 6) for each end: linear, without rotation."""
    return [np.diag([share] * 3 + [0.0] * 3) for share in (1 - xi, xi)]


def _beam(xi: float, e: np.ndarray, length: float, offset: np.ndarray) -> list[np.ndarray]:
    """Motion of a point of a beam, `offset` from its axis along the unit vector e, by that of its ends; (6, 6) for each end."""
    along, across, turn = np.outer(e, e), np.eye(3) - np.outer(e, e), _cross(e)
    cubic = (1 - 3 * xi**2 + 2 * xi**3, 3 * xi**2 - 2 * xi**3)
    slope = (xi - 2 * xi**2 + xi**3, xi**3 - xi**2)
    d_cubic = ((6 * xi**2 - 6 * xi) / length, (6 * xi - 6 * xi**2) / length)
    d_slope = (1 - 4 * xi + 3 * xi**2, 3 * xi**2 - 2 * xi)
    parts = []
    for end, share in enumerate((1 - xi, xi)):
        part = np.zeros((6, 6))
        part[:3, :3] = share * along + cubic[end] * across
        part[:3, 3:] = -slope[end] * length * turn  # theta x e = -(e x theta)
        part[3:, :3] = d_cubic[end] * turn  # theta across the axis is e x u'
        part[3:, 3:] = share * along + d_slope[end] * across
        part[:3] -= _cross(offset) @ part[3:]  # theta x r
        parts.append(part)
    return parts


def _cross(v: np.ndarray) -> np.ndarray:
    """The matrix (3, 3) of v x."""
    return np.array([[0.0, -v[2], v[1]], [v[2], 0.0, -v[0]], [-v[1], v[0], 0.0]])


def _among_nodes(geometry: Geometry, point: np.ndarray, nearest: int, follows: Following) -> PointMotion:
    """Least-norm weights, near nodes cheap, that reproduce every linear field."""
    distance = np.linalg.norm(geometry.coordinates - point, axis=1)
    nodes = np.argsort(distance, kind="stable")[:_NEIGHBOURS]
    near = distance[nodes]
    if near[0] <= 1e-9 * max(near[-1], np.finfo(float).tiny):
        return at_node(geometry, int(nodes[0]), follows)
    arms = (geometry.coordinates[nodes] - point) / near[-1]
    condition = np.vstack([np.ones(len(nodes)), arms.T]) / near  # of weights x distance
    share = np.linalg.lstsq(condition, np.array([1.0, 0, 0, 0]), rcond=1e-9)[0] / near
    size = float(np.linalg.norm(geometry.coordinates[nodes] - geometry.coordinates[nearest], axis=1).max())
    return _motion(follows, nodes, [np.eye(6) * part for part in share], float(near[0]), size, nearest)


def _motion(
    follows: Following, nodes: object, parts: list[np.ndarray], distance: float, reach: float, nearest: int
) -> PointMotion:
    """The motion given by `parts` (6, 6) of each of `nodes`, on the degrees of freedom that move them."""
    columns: dict[int, np.ndarray] = {}
    for node, part in zip(nodes, parts, strict=True):
        for d in range(6):
            for dof, factor in zip(*follows.of(node, d), strict=True):
                columns[int(dof)] = columns.get(int(dof), 0.0) + factor * part[:, d]
    weights = np.column_stack(list(columns.values())) if columns else np.zeros((6, 0))
    return PointMotion(np.array(list(columns), dtype=int), weights, distance, reach, nearest)
