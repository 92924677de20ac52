"""Forces of laws along a motion that is known: lines of linear laws, and steps of those with internal states."""

import numpy as np

from mouse_cli.terms.laws import Law


def linear_force(matrices: tuple[np.ndarray, ...], w: np.ndarray, X: np.ndarray, carried: np.ndarray) -> np.ndarray:
    """Lines (l, d) of the forces of a linear law against its motions X (l, d), its own degrees of freedom Q eliminated.

    The acceleration `carried` (l, d) of the ground carries its motions along, and what hangs on them with the first:
    [F, 0]' = Z [X, Q]' + M [carried, carried_1].
    """
    K, C, M = matrices
    Z, d = K + 1j * w[:, None, None] * C - w[:, None, None] ** 2 * M, X.shape[1]
    along = np.concatenate([carried, np.repeat(carried[:, :1], len(K) - d, axis=1)], axis=1) @ M.T
    F = np.einsum("lij,lj->li", Z[:, :d, :d], X) + along[:, :d]
    if len(K) == d:
        return F
    rest = np.einsum("lij,lj->li", Z[:, d:, :d], X) + along[:, d:]
    one = len(K) == d + 1
    Q = rest / Z[:, d, d:] if one else np.linalg.solve(Z[:, d:, d:], rest[:, :, None])[:, :, 0]
    return F - np.einsum("lij,lj->li", Z[:, :d, d:], Q)


def stepped(law: Law, x: np.ndarray, v: np.ndarray, p: np.ndarray, words: dict[str, float]) -> np.ndarray:
    """The forces (t, m) of a law with internal states along a motion (t,), for parameters (q, m)."""
    z, found, force = np.zeros((law.states, p.shape[1])), np.empty((len(x), p.shape[1])), law.along(p, words)
    for i in range(len(x)):
        found[i], z = force(x[i], v[i], z)
    return found
