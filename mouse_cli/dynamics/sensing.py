"""What sensors read of a motion: degrees of freedom as they are, or combinations of them."""

import numpy as np

from mouse_cli.model.arrays import Matrix, is_sparse


def read(sensing: Matrix, motion: np.ndarray) -> np.ndarray:
    """What the sensors read (s, k) of `motion` (n, k); sensing: degrees of freedom (s,), or weights (s, n)."""
    return motion[sensing] if sensing.ndim == 1 else sensing @ motion


def unit_loads(sensing: Matrix) -> tuple[np.ndarray, np.ndarray]:
    """The transpose of `read`, for adjoint solutions: degrees of freedom (r,), and loads (r, s) on them, one column a sensor."""
    if sensing.ndim == 1:
        return sensing, np.eye(len(sensing))
    if not is_sparse(sensing):
        return np.arange(sensing.shape[1]), sensing.T
    used = np.unique(sensing.tocoo().col)
    return used, sensing.tocsc()[:, used].toarray().T


def restricted(sensing: Matrix, matrix: Matrix) -> Matrix:
    """S matrix S' (s, s): `matrix` (n, n) as the sensors see it."""
    if sensing.ndim == 1:
        return matrix[sensing][:, sensing]
    return sensing @ (matrix @ sensing.T)
