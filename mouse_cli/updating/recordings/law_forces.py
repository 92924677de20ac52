"""Forces of laws along a motion that is known: lines of linear laws, and steps of those with internal states."""

import numpy as np

from mouse_cli.terms.laws import Law


def linear_force(
    matrices: tuple[np.ndarray, ...], w: np.ndarray, X: np.ndarray, carried: np.ndarray | float
) -> np.ndarray:
    """Lines (l,) of the force of a linear law against its motion X (l,), its own degrees of freedom eliminated.

    All of them are carried along with the acceleration `carried` of the ground: with 1 = (1, ..., 1),
    [F, 0]' = Z [X, Q]' + M 1 carried.
    """
    K, C, M = matrices
    Z = K + 1j * w[:, None, None] * C - w[:, None, None] ** 2 * M
    inertia = M.sum(axis=1)
    if len(K) == 1:
        return Z[:, 0, 0] * X + inertia[0] * carried
    back = np.linalg.solve(
        Z[:, 1:, 1:], np.concatenate([Z[:, 1:, :1], np.broadcast_to(inertia[1:, None], Z[:, 1:, :1].shape)], 2)
    )
    through = (Z[:, :1, 1:] @ back)[:, 0]
    return (Z[:, 0, 0] - through[:, 0]) * X + (inertia[0] - through[:, 1]) * carried


def stepped(law: Law, x: np.ndarray, v: np.ndarray, p: np.ndarray, words: dict[str, float]) -> np.ndarray:
    """The forces (t, m) of a law with internal states along a motion (t,), for parameters (q, m)."""
    z, found = np.zeros((law.states, p.shape[1])), np.empty((len(x), p.shape[1]))
    for i in range(len(x)):
        found[i], z = law.force(x[i], v[i], z, p, **words)
    return found
