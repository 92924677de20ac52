"""What coordinates leave out of members that lose or gain stiffness, and of springs between nodes, see `residual.py`.

A member with the stiffness K_e is loaded as the lowest modes load it, F = K_e V_m; of its response A^-1 F the coordinates V lack
Z = A^-1 F - V (V'A V)^-1 V'F, which is A-orthogonal to them. With Z'A Z = I and Z'K_e Z = diag(s), a share d of K_e that is added
(-d: lost) is felt, Z following with least energy, as

    d V'K_e V - sum over j of d^2 / (1 + d s_j) g_j g_j',    g = V'K_e Z

One element has but six strains, of which the modes leave none out: for it this is exact but for inertia. A spring k along b with
the residual flexibility R = b'A^-1 b - b'V (V'A V)^-1 V'b is felt as k / (1 + k R).
"""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.sites.bars import displacements
from mouse_cli.diagnosis.sites.residual import NUMBERS, Static
from mouse_cli.diagnosis.sites.strains import sparse_rows

_FULL = 1e-9 - 1  # share of its stiffness that a direction loses at most
_NOTHING = 1e-7  # share of the response to a load that the coordinates leave out, below which it is rounding


@dataclass(frozen=True)
class Left:
    """g (r, j) and s (j,) of a member."""

    g: np.ndarray
    s: np.ndarray

    def correction(self, share: float) -> np.ndarray:
        """What a share of K_e that is added, or lost if it is negative, does beyond share V'K_e V (r, r)."""
        return -(self.g * (share**2 / (1 + share * self.s))) @ self.g.T


@dataclass(frozen=True)
class Loaded:
    """A member of e elements: K (e, 12, 12); H = K_e V_m (12 e, m); X (12 e, m) of its nodes under these loads; A (m, m) = F'X."""

    K: np.ndarray
    H: np.ndarray
    X: np.ndarray
    A: np.ndarray

    def left(self, u: np.ndarray, eigenvalues: np.ndarray, shift: float) -> Left:
        """For the motion u (e, 12, r) of its nodes in coordinates of `eigenvalues` (r,)."""
        U = u.reshape(-1, u.shape[-1])
        c = U.T @ self.H
        kept = c / (eigenvalues - shift)[:, None]
        scale = 1 / np.sqrt(np.maximum(np.diag(self.A), 1e-300))
        w, Q = np.linalg.eigh((self.A - c.T @ kept) * scale * scale[:, None])
        chosen = w > _NOTHING
        Z = (self.X - U @ kept) @ (scale[:, None] * Q[:, chosen] / np.sqrt(w[chosen]))
        pushed = (self.K @ Z.reshape(len(self.K), 12, -1)).reshape(Z.shape)
        s, Q = np.linalg.eigh(Z.T @ pushed)
        return Left(U.T @ pushed @ Q, np.maximum(s, _FULL))


def left_out(model: Reduced, key: tuple, nodes: np.ndarray, stiffness: Callable[[Reduced], np.ndarray]) -> Left | None:
    """Of the member `key` with nodes (e, 2), K (e, 12, 12) the `stiffness` of a model; what its neighbours do follows that.

    None where it is too large.
    """
    taken = model if model.origin is None else replace(model, theta=model.origin, origin=None)  # what all static motion is of
    given = _loaded(model.static, key, nodes, lambda: stiffness(taken))
    if given is None:
        return None
    left = given.left(displacements(model.motion, nodes, model.V), model.eigenvalues, model.static.shift)
    grown = 1.0 if model.origin is None else np.linalg.norm(stiffness(model)) / np.linalg.norm(given.K)
    return Left(left.g * np.sqrt(grown), left.s)


def _loaded(static: Static | None, key: tuple, nodes: np.ndarray, stiffness: Callable[[], np.ndarray]) -> Loaded | None:
    """The member where all static motion is of, found once."""
    if static is None or static.modes.size * max(len(nodes), 1) > NUMBERS:
        return None
    if key not in static.kept:
        K = stiffness()
        rows = sparse_rows(static.motion, (6 * nodes[:, :, None] + np.arange(6)).ravel())
        u = (rows @ static.modes).reshape(len(K), 12, -1)
        H = (K @ u).reshape(rows.shape[0], -1)
        F = rows.T @ H
        moved = static.solve(np.ascontiguousarray(F))
        static.kept[key] = Loaded(K, H, rows @ moved, F.T @ moved)
    return static.kept[key]


def between(static: Static | None, ends: np.ndarray) -> np.ndarray | None:
    """Static motion (3 c, 3 c) of nodes `ends` (c,) by unit forces at them; None where these are too many."""
    if static is None or 3 * len(ends) * static.motion.n > NUMBERS:
        return None
    key = ("ends", ends.tobytes())
    if key not in static.kept:
        rows = sparse_rows(static.motion, (6 * ends[:, None] + np.arange(3)).ravel())
        static.kept[key] = rows @ static.solve(np.ascontiguousarray(rows.T.toarray()))
    return static.kept[key]
