"""The coordinates in which a model is simulated: its degrees of freedom, or modes and static answers of a larger one."""

import numpy as np

from mouse_cli.model.arrays import Matrix

LARGEST = 40  # degrees of freedom that are simulated as they are; larger models by modes
_MOST_MODES = 60


def basis_of(K: Matrix, M: Matrix, highest_hz: float, at: np.ndarray, largest: int = LARGEST) -> np.ndarray:
    """The degrees of freedom themselves; of a model of more than `largest` the modes up to `highest_hz`, and what the others add by
    their static flexibility at the motions `at` (n, q), those of sensors and forces.
    """
    n = K.shape[0]
    if n <= largest:
        return np.eye(n)
    from scipy.linalg import eigh
    from scipy.sparse import csc_array
    from scipy.sparse.linalg import splu

    from mouse_cli.dynamics.solver import EigenSolver

    limit = (2 * np.pi * highest_hz) ** 2
    found = EigenSolver().solve(K, M, min(_MOST_MODES, n))
    modes = np.asarray(found.shapes)[:, :_MOST_MODES][:, found.eigenvalues[:_MOST_MODES] < limit]
    if modes.shape[1] == n:
        return np.eye(n)
    static = splu(csc_array(K + limit * M)).solve(np.ascontiguousarray(at))
    static -= modes @ np.linalg.solve(modes.T @ (M @ modes), modes.T @ (M @ static))
    own, shares = np.linalg.svd(static / np.maximum(np.linalg.norm(static, axis=0), 1e-300), full_matrices=False)[:2]
    V = np.column_stack([modes, own[:, shares > 1e-6 * shares.max()]])
    return V @ eigh(V.T @ (K @ V), V.T @ (M @ V))[1]


def along(V: np.ndarray, M: Matrix) -> np.ndarray:
    """(V'MV)^-1 V'M (m, n): the coordinates of a motion, as exact in its load on V as the motion itself."""
    if V.shape[0] == V.shape[1]:
        return np.linalg.inv(V)
    momentum = (M @ V).T
    return np.linalg.solve(momentum @ V, momentum)
