"""Exact first derivatives of eigenvalues and mode-shape components with respect to elements of K and M.

With dZ = dK - lambda_i dM and x_i'Mx_i = 1 (Fox and Kapoor 1968, Eq. numbers of the report's O-4):

    d lambda_i = x_i' dZ x_i
    d x_i      = sum_{j != i} x_j x_j' dZ x_i / (lambda_i - lambda_j) - 1/2 (x_i' dM x_i) x_i

Each datum is u' dZ x_i with a left vector u of its own: x_i for the eigenvalue, -G_i e_s for component s, where
G_i = sum_{j != i} x_j x_j' / (lambda_j - lambda_i) runs over *all* modes. That is the adjoint form: its cost does not
depend on the number of elements, and for sparse models G_i e_s is one solve instead of all modes.
"""

from dataclasses import dataclass

import numpy as np

from mouse_cli.dynamics.eigen import EigenSolution, clusters
from mouse_cli.model._arrays import Matrix, is_sparse
from mouse_cli.model.structure import ListedElements


@dataclass(frozen=True)
class ModalPartials:
    """d_lambda (m, e) and d_shape (m, s, e): partial derivatives by the e listed elements, or by p properties."""

    d_lambda: np.ndarray
    d_shape: np.ndarray


def modal_partials(
    solution: EigenSolution,
    K: Matrix,
    M: Matrix,
    modes: np.ndarray,
    dofs: np.ndarray,
    elements: ListedElements,
    A: Matrix | None = None,
) -> ModalPartials:
    """B = d(lambda, x)/d(k, m) for the measured `modes` (m,) and `dofs` (s,), both from 0; Eq. (3-1) of the report.

    With A (e, p) it is T = B A, by p properties instead of e elements, and the whole of B is never held.
    A listed off-diagonal element moves together with its mirror image. Modes closer than 1e-6, relative, are treated
    as a subspace: derivatives within it are those of parallel transport.
    """
    m, s, e = len(modes), len(dofs), len(elements)
    columns = e if A is None else A.shape[1]
    d_lambda, d_shape, block = np.empty((m, columns)), np.empty((m, s, columns)), np.empty((s, e))
    a, b, mass = elements.row, elements.col, elements.is_mass
    off = np.flatnonzero(a != b)
    twice = np.where(a == b, 1.0, 2.0)
    touched, place = np.unique(np.concatenate([a, b]), return_inverse=True)
    at_a, at_b = place[:e], place[e:][off]
    family = clusters(solution.eigenvalues)
    for i, mode in enumerate(modes):
        x, lam = solution.shapes[:, mode], solution.eigenvalues[mode]
        same = np.flatnonzero(family == family[mode])
        weight = np.where(mass, -lam, 1.0)
        row = weight * twice * x[a] * x[b]
        d_lambda[i] = row if A is None else row @ A
        if not s:
            continue
        G = _reduced_inverse(solution, K, M, mode, same, dofs, touched)
        np.multiply(G[:, at_a], -weight * x[b], out=block)
        block[:, off] -= G[:, at_b] * (weight * x[a])[off]
        if mass.any():  # the length of x_i follows the mass: -1/2 sum_k x_k (x_k' dM x_i) over its cluster
            X = solution.shapes[:, same]
            along = x[b][:, None] * X[a]
            along[off] += x[a][off, None] * X[b[off]]
            block -= 0.5 * X[dofs] @ np.where(mass[:, None], along, 0.0).T
        d_shape[i] = block if A is None else contract(block, A)
    return ModalPartials(d_lambda, d_shape)


def _reduced_inverse(
    solution: EigenSolution,
    K: Matrix,
    M: Matrix,
    mode: int,
    same: np.ndarray,
    dofs: np.ndarray,
    touched: np.ndarray,
) -> np.ndarray:
    """Rows e_s'G_i (s, t) of the measured dofs at the `touched` ones: the inverse of K - lambda_i M outside the cluster."""
    if not solution.complete:
        return np.ascontiguousarray(_bordered(solution, K, M, mode, same, dofs)[touched].T)
    distance = solution.eigenvalues - solution.eigenvalues[mode]
    distance[same] = np.inf
    return (solution.shapes[dofs] / distance) @ solution.shapes[touched].T


def _bordered(
    solution: EigenSolution, K: Matrix, M: Matrix, mode: int, same: np.ndarray, dofs: np.ndarray
) -> np.ndarray:
    """G_i e_s without the other modes: (K - lambda_i M) bordered by M X of the cluster is regular (Lee and Jung 1997)."""
    from scipy.sparse import block_array, csc_array
    from scipy.sparse.linalg import splu

    n, c = K.shape[0], len(same)
    X = solution.shapes[:, same]
    border = M @ X
    shifted = csc_array(K) - solution.eigenvalues[mode] * csc_array(M)
    matrix = block_array([[shifted, csc_array(border)], [csc_array(border.T), None]], format="csc")
    right = np.zeros((n + c, len(dofs)))
    right[dofs, np.arange(len(dofs))] = 1.0
    right[:n] -= border @ X[dofs].T
    return splu(matrix, permc_spec="MMD_AT_PLUS_A").solve(right)[:n]


def contract(B: np.ndarray, A: Matrix) -> np.ndarray:
    """T = B A (q, p): from the listed elements to the physical properties, Eq. (3-3)."""
    return (A.T @ B.T).T if is_sparse(A) else B @ A
