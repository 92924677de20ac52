"""The matrices of coupled models assembled as they are: u = L q, with B L = 0, K = L' diag(K_A, K_B, ...) L (lecture 22).

Connections add k b b' and m b b' at their places, b the rows of their motion; an absorber adds a degree of freedom.
"""

from dataclasses import dataclass

import numpy as np

from mouse_cli.model.arrays import Matrix, is_sparse
from mouse_cli.model.coupling import Connection, Coupling

_DEPENDENT = 1e-10  # of the largest pivot: a condition that others imply


@dataclass(frozen=True)
class Rows:
    """What each interface and each connection reads of all degrees of freedom of all parts, side by side: (c, n), (k, n),
    sparse."""

    interfaces: Matrix
    connections: Matrix


def rows(coupling: Coupling) -> Rows:
    """B of interfaces and b of connections, over the degrees of freedom of all parts."""
    from scipy.sparse import block_diag, csr_array, vstack

    parts = coupling.substructures
    weights = csr_array(block_diag([part.weights for part in parts], format="csr"))
    first = np.cumsum([0, *(len(part.places) for part in parts)])
    motion = lambda point: weights[[first[point.substructure] + point.place]]
    empty = csr_array((0, weights.shape[1]))
    between = [motion(a) - motion(b) for a, b in coupling.interfaces]
    own = [motion(one.at) - motion(one.to) if one.to else motion(one.at) for one in coupling.connections]
    return Rows(*(csr_array(vstack(each)) if each else empty for each in (between, own)))


def added(connections: tuple[Connection, ...], b: Matrix, n: int) -> tuple[Matrix, Matrix, Matrix, Matrix]:
    """What connections add to K, M, C and D (n + absorbers, same): sparse. b (k, n): rows of their motion."""
    from scipy.sparse import csr_array, vstack

    hung = [k for k, one in enumerate(connections) if one.hung]
    size = n + len(hung)
    wide = csr_array((b.data, b.indices, b.indptr), shape=(b.shape[0], size))
    own = {k: csr_array(([1.0], ([0], [n + j])), shape=(1, size)) for j, k in enumerate(hung)}
    stretch = [wide[[k]] - own[k] if k in own else wide[[k]] for k in range(len(connections))]
    moving = [own[k] if k in own else wide[[k]] for k in range(len(connections))]
    stretch, moving = (csr_array(vstack(each)) if each else csr_array((0, size)) for each in (stretch, moving))
    summed = lambda motion, values: csr_array(motion.T @ (motion * np.asarray(values, float)[:, None]))
    return (
        summed(stretch, [one.stiffness for one in connections]),
        summed(moving, [one.mass for one in connections]),
        summed(stretch, [one.damping for one in connections]),
        summed(stretch, [one.stiffness * one.loss_factor for one in connections]),
    )


def kernel(B: Matrix) -> Matrix:
    """L (n, q), sparse, whose columns span B L = 0: each condition gives up one degree of freedom, the largest that it can.

    Conditions that others imply give up none. Only the degrees of freedom that B touches are worked on, by QR with pivoting.
    """
    from scipy.linalg import qr, solve_triangular
    from scipy.sparse import csr_array, eye_array

    n, touched = B.shape[1], np.unique(B.indices[B.data != 0])
    if not len(touched):
        return csr_array(eye_array(n))
    _, R, order = qr(B[:, touched].toarray(), mode="economic", pivoting=True)
    pivots = np.abs(np.diag(R))
    rank = int(np.count_nonzero(pivots > _DEPENDENT * pivots[0]))
    follow = -solve_triangular(R[:rank, :rank], R[:rank, rank:])
    slaves, masters = touched[order[:rank]], touched[order[rank:]]
    kept = np.setdiff1d(np.arange(n), slaves)
    number = np.full(n, -1)
    number[kept] = np.arange(len(kept))
    row, col = np.nonzero(follow)
    value = np.concatenate([np.ones(len(kept)), follow[row, col]])
    place = np.concatenate([kept, slaves[row]]), np.concatenate([np.arange(len(kept)), number[masters[col]]])
    return csr_array((value, place), shape=(n, len(kept)))


def assembled(coupling: Coupling, matrices: list[tuple[Matrix, Matrix]]) -> tuple[Matrix, Matrix]:
    """K and M of the whole: dense where all parts are."""
    from scipy.sparse import block_diag, csr_array

    found = rows(coupling)
    K, M = (csr_array(block_diag([each[k] for each in matrices], format="csr")) for k in (0, 1))
    dK, dM, _, _ = added(coupling.connections, found.connections, K.shape[0])
    size = dK.shape[0]
    for each in (K, M):
        each.resize((size, size))
    B = csr_array(
        (found.interfaces.data, found.interfaces.indices, found.interfaces.indptr),
        shape=(found.interfaces.shape[0], size),
    )
    L = kernel(B)
    whole = [csr_array(L.T @ (each @ L)) for each in (K + dK, M + dM)]
    return tuple(whole) if any(is_sparse(each[0]) for each in matrices) else tuple(each.toarray() for each in whole)


def boundary(coupling: Coupling, k: int) -> np.ndarray:
    """Places (from 0) of part k at which interfaces or connections act."""
    points = [p for pair in coupling.interfaces for p in pair]
    points += [p for one in coupling.connections for p in (one.at, one.to) if p is not None]
    return np.unique([p.place for p in points if p.substructure == k]).astype(int)
