"""What supports and rigid links leave free: the motion of every node from the degrees of freedom of the model."""

from dataclasses import dataclass

import numpy as np

from mouse_cli.model.geometry import Geometry
from mouse_cli.model.mesh import Mesh
from mouse_cli.terms.faults import LinkLoop, Overconstrained


@dataclass(frozen=True)
class Motion:
    """u = T q: displacement u of every direction of every node (and of `extra` degrees of freedom beside) from q (n,).

    Row r of T, r = 6 node + direction, has the coefficients factor[start[r]:start[r + 1]] at the columns dof[...].
    places (n,): the row of each degree of freedom.
    """

    start: np.ndarray
    dof: np.ndarray
    factor: np.ndarray
    places: np.ndarray

    @property
    def n(self) -> int:
        """Number of degrees of freedom."""
        return len(self.places)

    @property
    def counts(self) -> np.ndarray:
        """How many degrees of freedom move each direction of each node."""
        return np.diff(self.start)

    def of(self, node: int, direction: int) -> tuple[np.ndarray, np.ndarray]:
        """Degrees of freedom (from 0) and factors that make up the motion of a node; empty where it cannot move."""
        at = slice(self.start[6 * node + direction], self.start[6 * node + direction + 1])
        return self.dof[at], self.factor[at]

    def rows(self, places: np.ndarray) -> np.ndarray:
        """The rows `places` of T, dense (r, n)."""
        T = np.zeros((len(places), self.n))
        for i, r in enumerate(places):
            at = slice(self.start[r], self.start[r + 1])
            T[i, self.dof[at]] = self.factor[at]
        return T

    def apply(self, q: np.ndarray) -> np.ndarray:
        """T q for q (n, ...)."""
        row = np.repeat(np.arange(len(self.start) - 1), self.counts)
        out = np.zeros((len(self.start) - 1, *q.shape[1:]), q.dtype)
        np.add.at(out, row, self.factor.reshape(-1, *[1] * (q.ndim - 1)) * q[self.dof])
        return out

    def load(self, f: np.ndarray) -> np.ndarray:
        """T' f (n,) for loads f on all directions of all nodes."""
        row = np.repeat(np.arange(len(self.start) - 1), self.counts)
        return np.bincount(self.dof, self.factor * f[row], minlength=self.n)

    def spread(
        self, row: np.ndarray, col: np.ndarray
    ) -> tuple[np.ndarray | None, np.ndarray, np.ndarray, np.ndarray | None]:
        """T' E T for entries E at (row, col): which entry, row, column and factor, of each contribution.

        No entries and factors (None) where every direction moves with one degree of freedom alone.
        """
        counts, first = self.counts, self.start[:-1]
        if (self.factor == 1).all() and (counts[row] == 1).all() and (counts[col] == 1).all():
            return None, self.dof[first[row]], self.dof[first[col]], None
        across = counts[col]
        many = counts[row] * across
        entry = np.repeat(np.arange(len(row)), many)
        within = np.arange(len(entry)) - np.repeat(np.cumsum(many) - many, many)
        across = across[entry]
        i, j = first[row[entry]] + within // across, first[col[entry]] + within % across
        return entry, self.dof[i], self.dof[j], self.factor[i] * self.factor[j]


@dataclass(frozen=True)
class Links:
    """free (r,): mask of the directions that may move by themselves; rows: what dependent ones follow, {r: {r': factor}}."""

    free: np.ndarray
    rows: dict[int, dict[int, float]]

    def stiff(self, held: np.ndarray) -> np.ndarray:
        """`held` (r,), and the directions through whose motion a held one moves."""
        found = held.copy()
        for row, follows in self.rows.items():
            if held[row]:
                found[[r for r, factor in follows.items() if factor]] = True
        return found

    def motion(self, order: np.ndarray) -> Motion:
        """T whose columns are the directions `order` (n,), in that order; all other free ones do not move."""
        column = np.full(len(self.free), -1)
        column[order] = np.arange(len(order))
        counts = (column >= 0).astype(int)
        dependent = {r: {c: f for c, f in row.items() if column[c] >= 0 and f} for r, row in self.rows.items()}
        for r, row in dependent.items():
            counts[r] = len(row)
        start = np.concatenate([[0], np.cumsum(counts)])
        dof, factor = np.zeros(start[-1], int), np.ones(start[-1])
        dof[start[:-1][column >= 0]] = column[column >= 0]
        for r, row in dependent.items():
            at = slice(start[r], start[r + 1])
            dof[at], factor[at] = column[list(row)], list(row.values())
        return Motion(start, dof, factor, order)


def links(mesh: Mesh, extra: int = 0) -> Links:
    """What the supports and links of `mesh` leave free, with `extra` further degrees of freedom beside its nodes.

    Raises Overconstrained where a direction is held twice, LinkLoop where links follow one another in a circle.
    """
    free = np.zeros((len(mesh.node_ids), 6), bool)
    free[:, list(mesh.directions)] = True
    free[mesh.supports[:, 0], mesh.supports[:, 1]] = False
    free = np.concatenate([free.ravel(), np.ones(extra, bool)])
    direct: dict[int, dict[int, float]] = {}
    for link in mesh.links:
        arm = mesh.coordinates[link.dependent] - mesh.coordinates[link.independent]
        for d in link.directions:
            r = 6 * link.dependent + d
            if d not in mesh.directions:
                continue
            if not free[r] or r in direct:
                raise Overconstrained(((int(mesh.node_ids[link.dependent]), d),))
            direct[r] = {6 * link.independent + i: f for i, f in _follows(arm, d)}
    free[list(direct)] = False
    rows = {r: _resolved(r, direct, free, mesh, ()) for r in direct}
    return Links(free, rows)


def following(mesh: Mesh, geometry: Geometry) -> Motion:
    """T of a structure that is built: degrees of freedom in the order of `geometry`, those without a node after the nodes."""
    place, alone = 6 * geometry.node + geometry.direction, geometry.node < 0
    place[alone] = 6 * len(mesh.node_ids) + np.arange(int(alone.sum()))
    return links(mesh, int(alone.sum())).motion(place)


def _follows(arm: np.ndarray, d: int) -> list[tuple[int, float]]:
    """What direction d of the end of a rigid `arm` follows at its origin: u + theta x arm, and theta."""
    if d > 2:
        return [(d, 1.0)]
    i, j = (d + 1) % 3, (d + 2) % 3
    return [(d, 1.0), (3 + i, float(arm[j])), (3 + j, -float(arm[i]))]


def _resolved(r: int, direct: dict, free: np.ndarray, mesh: Mesh, chain: tuple[int, ...]) -> dict[int, float]:
    """Direction r as a sum of directions that are free."""
    if r in chain:
        raise LinkLoop(tuple(sorted({int(mesh.node_ids[c // 6]) for c in chain})))
    if r not in direct:
        return {r: 1.0} if free[r] else {}
    found: dict[int, float] = {}
    for c, factor in direct[r].items():
        if factor:
            for free_one, share in _resolved(c, direct, free, mesh, (*chain, r)).items():
                found[free_one] = found.get(free_one, 0.0) + factor * share
    return found
