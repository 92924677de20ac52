"""Leading eigenvectors of the correlation of a smooth field between many places."""

import numpy as np

_LEFT, _COLUMNS = 1e-4, 200  # share of the variance that the factor may leave, and its columns at most
_FLAT = 1e-6  # share of the largest extent below which there is none along an axis
KEPT, MOST = 0.995, 16  # share of the variance that is kept, and eigenvectors at most


def leading(at: np.ndarray, length: float) -> np.ndarray:
    """P (c, w) of c places `at` (c, d): P P' is exp(-|x_i - x_j|^2 / 2 l^2) but for 1 - KEPT of it, or what MOST vectors leave.

    By Cholesky's factor A = F F' with the largest pivots first, which ends when little is left (Harbrecht, Peters and Schneider,
    Appl. Numer. Math. 62, 2012): the eigenvalues of F'F are those of A.
    """
    left, F = np.ones(len(at)), np.zeros((len(at), 0))
    while F.shape[1] < min(len(at), _COLUMNS) and left.sum() > _LEFT * len(at):
        i = int(np.argmax(left))
        column = np.exp(-0.5 * ((at - at[i]) ** 2).sum(axis=1) / length**2) - F @ F[i]
        F = np.column_stack([F, column / np.sqrt(left[i])])
        left = np.maximum(1 - (F**2).sum(axis=1), 0.0)
    size, W = np.linalg.eigh(F.T @ F)
    size, W = size[::-1], W[:, ::-1]
    kept = min(MOST, int(np.searchsorted(np.cumsum(size) / len(at), KEPT)) + 1)
    return F @ W[:, :kept]


def affine(at: np.ndarray) -> np.ndarray:
    """A constant and a slope along each axis (c, 1 + a) over places `at` (c, d), of mean square one; a axes have an extent."""
    slopes = at - at.mean(axis=0)
    size = np.sqrt((slopes**2).mean(axis=0))
    kept = size > _FLAT * size.max(initial=0.0)
    return np.hstack([np.ones((len(at), 1)), slopes[:, kept] / size[kept]])


def extent(at: np.ndarray) -> float:
    """The diagonal of the box that holds all places."""
    return float(np.linalg.norm(np.ptp(at, axis=0)))


def spacing(at: np.ndarray) -> float:
    """Median distance from a place to the next one."""
    places = np.unique(at, axis=0)
    if len(places) < 2:
        return 0.0
    from scipy.spatial import cKDTree

    return float(np.median(cKDTree(places).query(places, 2)[0][:, 1]))
