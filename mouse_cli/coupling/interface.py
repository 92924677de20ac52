"""The forces at an interface, line by line: (B Y B' + 1/z) g = B Y f, and what they make of the functions.

With c conditions B u = 0 between the places of parts with receptances Y, Lagrange multipliers g hold the parts together:

    Y_C = Y - Y B' (B Y B' + 1/z)^-1 B Y                     (de Klerk, Rixen and Voormeeren, AIAA Journal 46 (2008) 1169)

z = infinity joins rigidly; any other dynamic stiffness z is that of a connection with one degree of freedom. For two parts
that share all their degrees of freedom it is H_A - H_A (H_A + H_B)^-1 H_A of lecture 22.
"""

from dataclasses import dataclass

import numpy as np

_FEW = 40  # conditions up to which all lines are inverted at once, and their condition numbers are exact


@dataclass(frozen=True)
class Solved:
    """forces (f, c, i) = G^+ right; adjoint (f, o, c) = left G^+; condition (f,); kept (f,): singular values used; size (f,): the
    largest singular value, or a bound near it, of the scaled G; scale (f, c): by which G was scaled on both sides."""

    forces: np.ndarray
    adjoint: np.ndarray | None
    condition: np.ndarray
    kept: np.ndarray
    size: np.ndarray
    scale: np.ndarray


def solve(
    G: np.ndarray,
    size: np.ndarray,
    stiffness: np.ndarray,
    right: np.ndarray,
    left: np.ndarray | None = None,
    truncate: float = 0.0,
) -> Solved:
    """Solve (G + 1/z) g = right for G = B Y B' (f, c, c), and where left is given the transposed problem too.

    G is used up. size (f, c): sum of the magnitudes of the receptances of each condition, by which all is scaled, so that neither
    condition numbers nor truncation depend on units. stiffness z (f, c): inf where joined rigidly, 0 where nothing acts. truncate:
    singular values of the scaled matrix below this share of the largest are left out; 0: none, and LU does it.
    Raises numpy.linalg.LinAlgError where the matrix is singular.
    """
    scale = _scale(size, stiffness)
    for each, by in zip(G, scale, strict=True):
        each *= np.outer(by, by)
    np.einsum("fcc->fc", G)[:] += _own(scale, stiffness)
    right = right * scale[:, :, None]
    left = None if left is None else left * scale[:, None, :]
    way = _truncated if truncate > 0 else _inverted if G.shape[1] <= _FEW else _factorised
    forces, adjoint, condition, kept, largest = way(G, right, left, truncate)
    adjoint = None if adjoint is None else adjoint * scale[:, None, :]
    return Solved(forces * scale[:, :, None], adjoint, condition, kept, largest, scale)


def _scale(size: np.ndarray, z: np.ndarray) -> np.ndarray:
    """1 / sqrt(size + 1/|z|) (f, c); near sqrt|z| for a connection that does next to nothing."""
    strength = np.abs(z)
    with np.errstate(divide="ignore", invalid="ignore"):
        total = np.where(np.isinf(strength), size, size + 1 / np.where(strength > 0, strength, 1.0))
        found = np.where(strength > 0, 1 / np.sqrt(total), 0.0)
    return np.where(np.isfinite(found), found, 1.0)


def _own(scale: np.ndarray, z: np.ndarray) -> np.ndarray:
    """scale^2 / z (f, c): 0 where joined rigidly, 1 where nothing acts."""
    acting = np.isfinite(z) & (np.abs(z) > 0)
    return np.where(acting, scale**2 / np.where(acting, z, 1.0), np.where(np.isfinite(z), 1.0, 0.0))


def _norm(G: np.ndarray) -> np.ndarray:
    """1-norms (f,); line by line, and without the care for overflow that the absolute value takes: G is scaled."""
    return np.array([np.sqrt(each.real**2 + each.imag**2).sum(axis=0).max(initial=0.0) for each in G])


def _inverted(G: np.ndarray, right: np.ndarray, left: np.ndarray | None, truncate: float) -> tuple:
    """Few conditions: all lines at once; condition numbers in the 1-norm."""
    inverse = np.linalg.inv(G)
    norm = _norm(G)
    adjoint = None if left is None else np.matmul(left, inverse)
    solved = np.linalg.solve(G, right)  # to more digits than by the inverse
    return solved, adjoint, norm * _norm(inverse), np.full(len(G), G.shape[1]), norm


def _factorised(G: np.ndarray, right: np.ndarray, left: np.ndarray | None, truncate: float) -> tuple:
    """Many conditions: LU line by line, condition numbers as LAPACK estimates them from the factors."""
    from scipy.linalg import lapack

    f, c = G.shape[:2]
    forces, adjoint = np.empty_like(right), None if left is None else np.empty_like(left)
    condition, norm = np.empty(f), _norm(G)
    for i in range(f):  # the transpose of each is in the order of LAPACK, so that nothing is copied
        lu, pivots, singular = lapack.zgetrf(G[i].T, overwrite_a=True)
        if singular > 0:
            raise np.linalg.LinAlgError("singular interface")
        condition[i] = 1 / max(lapack.zgecon(lu, np.abs(norm[i]), norm="I")[0], np.finfo(float).tiny)
        forces[i] = lapack.zgetrs(lu, pivots, np.asfortranarray(right[i]), trans=1)[0]
        if adjoint is not None:
            adjoint[i] = lapack.zgetrs(lu, pivots, left[i].T, trans=0)[0].T
    return forces, adjoint, condition, np.full(f, c), norm


def _truncated(G: np.ndarray, right: np.ndarray, left: np.ndarray | None, truncate: float) -> tuple:
    """Singular values above `truncate` times the largest alone; condition numbers in the 2-norm, of all of them."""
    U, s, Vh = np.linalg.svd(G)
    keep = s > truncate * s[:, :1]
    inverse = np.where(keep, 1 / np.where(keep, s, 1.0), 0.0)
    UH, V = np.conj(np.swapaxes(U, 1, 2)), np.conj(np.swapaxes(Vh, 1, 2))
    forces = np.matmul(V, inverse[:, :, None] * np.matmul(UH, right))
    adjoint = None if left is None else np.matmul(np.matmul(left, V) * inverse[:, None, :], UH)
    with np.errstate(divide="ignore"):
        condition = s[:, 0] / s[:, -1]
    return forces, adjoint, condition, keep.sum(axis=1), s[:, 0]
