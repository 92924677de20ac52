"""What coordinates of a large model leave out where something hangs on a node: how forces and moments on it move the structure.

A mass on an arm loads its node with moments as well as forces, and the lowest modes hardly know how stiff the structure is against
these. Of the responses A^-1 B' to loads on the node, B its six motions, A = K - sigma M, the coordinates V lack

    Z = A^-1 B' - V (V'A V)^-1 V'B',    V'A Z = 0

(residual attachment modes, Craig and Kurdila 2006, ch. 17), which become degrees of freedom of the cause's own.
"""

from dataclasses import dataclass

import numpy as np

from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.likelihoods.modal.scales import highest
from mouse_cli.diagnosis.sites.residual import NUMBERS, Static
from mouse_cli.diagnosis.sites.strains import sparse_rows
from mouse_cli.dynamics.sensing import read
from mouse_cli.model.arrays import Matrix

_NOTHING = 1e-6  # share of the response to a load that the coordinates leave out, below which it is rounding
_LIGHT = 1e-6  # of 1 / highest measured eigenvalue: mass that lets what has none follow as statics would have it


@dataclass(frozen=True)
class Attached:
    """How a node moves, rows (6, r + a), with a degrees of freedom of its own beyond the r of the model.

    K, M (r + a, r + a) and sensing (s, r + a) of these; None where there are none.
    """

    rows: np.ndarray
    own: int = 0
    K: np.ndarray | None = None
    M: np.ndarray | None = None
    sensing: np.ndarray | None = None

    def with_mass(self, M: np.ndarray) -> np.ndarray:
        """A mass matrix (r + a, r + a) on the node, with that of its own degrees of freedom."""
        return M if self.M is None else self.M + M


def attached(model: Reduced, nodes: list[int]) -> list[Attached]:
    """The same of `nodes` (indices); a model in all of its coordinates lacks nothing."""
    static = model.static
    if static is None or not nodes or 6 * len(nodes) * static.motion.n > NUMBERS:
        return [Attached(model.node(node)) for node in nodes]
    K, M = model.assembly.matrices(model.theta)
    return [_beyond(model, node, X, K, M) for node, X in zip(nodes, _moved(static, nodes), strict=True)]


def flexibility(model: Reduced, motions: tuple[tuple[int, int], ...], rows: np.ndarray) -> np.ndarray:
    """R (c, c): what coordinates leave out of b_i A^-1 b_j', b the `motions` (node, direction), with `rows` (c, r) in them."""
    static, nodes = model.static, sorted({node for node, _ in motions})
    if static is None or 6 * len(nodes) * static.motion.n > NUMBERS:
        return np.zeros((len(motions), len(motions)))
    moved = dict(zip(nodes, _moved(static, nodes), strict=True))
    X = np.stack([moved[node][:, d] for node, d in motions], axis=1)
    at = [6 * nodes.index(node) + d for node, d in motions]
    left = (_at(static, nodes) @ X)[at] - rows / (model.eigenvalues - static.shift) @ rows.T
    return 0.5 * (left + left.T)


def _at(static: Static, nodes: list[int]):
    """B (6 c, n) of nodes, sparse."""
    return sparse_rows(static.motion, (6 * np.array(nodes)[:, None] + np.arange(6)).ravel())


def _moved(static: Static, nodes: list[int]) -> list[np.ndarray]:
    """A^-1 B' (n, 6) of each node, found once."""
    new = [node for node in nodes if ("node", node) not in static.kept]
    if new:
        found = static.solve(np.ascontiguousarray(_at(static, new).T.toarray()))
        for i, node in enumerate(new):
            static.kept["node", node] = np.ascontiguousarray(found[:, 6 * i : 6 * i + 6])
    return [static.kept["node", node] for node in nodes]


def _beyond(model: Reduced, node: int, X: np.ndarray, K: Matrix, M: Matrix) -> Attached:
    """Of a node with the responses X (n, 6); K, M (n, n) at the parameters of the model. Z is scaled to Z'A Z = 1."""
    rows, B, shift = model.node(node), _at(model.static, [node]), model.static.shift
    flexible = B @ X
    kept = rows.T / (model.eigenvalues - shift)[:, None]
    scale = 1 / np.sqrt(np.maximum(np.diag(flexible), 1e-300))
    w, Q = np.linalg.eigh((flexible - rows @ kept) * scale * scale[:, None])
    chosen = w > _NOTHING
    if not chosen.any():
        return Attached(rows)
    Z = (X - model.V @ kept) @ (scale[:, None] * Q[:, chosen] / np.sqrt(w[chosen]))
    light = np.eye(Z.shape[1]) * _LIGHT / highest(model)
    sensing = np.hstack([np.zeros_like(model.sensing), read(model.problem.test.measured_at, Z)])
    stiff, heavy = _block(model.V, Z, K @ Z), _block(model.V, Z, M @ Z, light)
    return Attached(np.hstack([rows, B @ Z]), Z.shape[1], stiff, heavy, sensing)


def _block(V: np.ndarray, Z: np.ndarray, push: np.ndarray, more: np.ndarray | float = 0.0) -> np.ndarray:
    """What Z (n, a) adds (r + a, r + a) to a matrix that makes `push` (n, a) of it."""
    r, own = V.shape[1], Z.T @ push
    added = np.zeros((r + len(own), r + len(own)))
    added[:r, r:] = V.T @ push
    added[r:, :r] = added[:r, r:].T
    added[r:, r:] = 0.5 * (own + own.T) + more
    return added
