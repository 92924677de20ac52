"""Damping by modes: what a deck states or leaves out, as viscous damping, and how it follows the modes of an altered model.

C = M X diag(2 zeta_r omega_r) X'M, X'MX = I (Wilson and Penzien 1972). A ratio belongs to a mode of the structure that is there:
where a mechanism changes mass or stiffness, X and omega are those of the model with it, and zeta_r is kept mode by mode.
"""

import numpy as np

from mouse_cli.model.modal_damping import ModalDamping

UNDAMPED = 0.01  # damping ratio assumed of each mode where the deck has no damping
_STILL = 1e-12  # of the largest eigenvalue: what is a rigid-body mode


def by_ratios(K: np.ndarray, M: np.ndarray, stated: ModalDamping | None) -> np.ndarray:
    """Damping (n, n) by the ratios that a deck states of elastic modes; UNDAMPED of each mode where it states none."""
    w, L, Q = _modes(K, M)
    ratio = np.full(len(w), UNDAMPED)
    if stated is not None:
        elastic = w > w.max(initial=0.0) * np.sqrt(_STILL) * len(w)
        ratio = np.where(elastic, stated.ratio[np.clip(np.cumsum(elastic) - 1, 0, len(stated.ratio) - 1)], 0.0)
    return _damping(ratio, w, L, Q)


def structural(K: np.ndarray, M: np.ndarray, D: np.ndarray) -> np.ndarray:
    """Structural damping D (n, n), the imaginary part of K, as the viscous one that damps each mode as much."""
    w, L, Q = _modes(K, M)
    X = np.linalg.solve(L.T, Q)
    return _damping(np.einsum("ij,ik,kj->j", X, D, X) / (2 * w**2), w, L, Q)


def followed(C: np.ndarray, before: tuple[np.ndarray, np.ndarray], after: tuple[np.ndarray, np.ndarray]) -> np.ndarray:
    """What C (P, n, n), by modes, changes by where they are those of K, M (P, n, n) `after`: ratios are those of modes `before`.

    Parameters of the deck move modes as laws do: where damping told a mass of either from the other, they shared one falsely.
    Nothing where a matrix of masses is not that of a structure: no motion of it will stay finite.
    """
    found = np.zeros_like(C)
    own = np.linalg.eigvalsh(after[1])[:, 0] > 0
    if not own.any():
        return found
    w, L, Q = _modes(*(one[own] for one in before))
    X = np.linalg.solve(L.swapaxes(-1, -2), Q)
    ratio = np.einsum("pij,pik,pkj->pj", X, C[own], X) / (2 * w)
    found[own] = _damping(ratio, *_modes(*(one[own] for one in after))) - C[own]
    return found


def _modes(K: np.ndarray, M: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Circular frequencies w (..., n), none of them 0, and L, Q (..., n, n) with M = L L', M X = L Q."""
    L = np.linalg.cholesky(M)
    half = np.linalg.solve(L, K)
    values, Q = np.linalg.eigh(np.linalg.solve(L, half.swapaxes(-1, -2)))
    least = _STILL * values.max(axis=-1, initial=0.0, keepdims=True)
    return np.sqrt(np.maximum(values, np.where(least > 0, least, _STILL))), L, Q


def _damping(ratio: np.ndarray, w: np.ndarray, L: np.ndarray, Q: np.ndarray) -> np.ndarray:
    forces = L @ Q
    return (forces * (2 * ratio * w)[..., None, :]) @ forces.swapaxes(-1, -2)
