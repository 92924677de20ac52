"""Motions that nothing resists: those of rigid parts, which may be meant, and mechanisms, which are faults."""

import numpy as np

from mouse_cli.model.arrays import Matrix, is_sparse
from mouse_cli.model.mesh import Mesh
from mouse_cli.terms.constraints import Motion
from mouse_cli.terms.element_matrices import ElementMatrices
from mouse_cli.terms.elements._axes import arm
from mouse_cli.terms.faults import Mechanism, Remark, floating

LARGEST = 200_000  # degrees of freedom; larger models are not searched
_NONE = 1e-22  # energy of a motion of unit size, in units of the diagonal of K, that counts as none
_BLOCK, _PASSES, _SHIFT = 8, 6, 1e-12


def search(
    mesh: Mesh, sets: list[ElementMatrices], motion: Motion, K: Matrix, attached: np.ndarray
) -> tuple[Remark, ...]:
    """The parts that may move as rigid bodies. Raises Mechanism for any other motion without stiffness.

    Energies are summed element by element from deformations, which tells none from little where K alone cannot: the lowest
    frequencies of a long chain of beams are below the rounding of K. attached (n,): mask of the degrees of freedom of imported
    matrices, which may hold what they touch and are not looked into.
    """
    if not motion.n or motion.n > LARGEST:
        return ()
    scale = np.sqrt(np.abs(K.diagonal()))
    scale[scale == 0] = 1.0
    strain = _Strain(mesh, sets, motion)
    remarks, rigid = [], [np.zeros((motion.n, 0))]
    for nodes in _parts(mesh):
        Q = _rigid(mesh, nodes, motion, strain, scale, attached)
        if Q.shape[1]:
            rigid.append(Q)
            remarks.append(floating(tuple(sorted(mesh.node_ids[nodes].tolist())), Q.shape[1]))
    lost = _lowest(K, scale, np.hstack(rigid))
    lost[attached] = 0.0
    lost = lost[:, np.linalg.norm(lost, axis=0) > 0.1]
    if lost.shape[1]:
        lost /= np.linalg.norm(lost, axis=0)
        energy, combination = np.linalg.eigh(strain.energies(lost / scale[:, None]))
        least = np.abs(energy).argmin()
        if abs(energy[least]) < _NONE:
            raise Mechanism(_most(mesh, motion, lost @ combination[:, least] / scale))
    return tuple(remarks)


class _Strain:
    """Energies of motions: rigid motion about its first node is taken out of each element before K acts on the rest."""

    def __init__(self, mesh: Mesh, sets: list[ElementMatrices], motion: Motion):
        self.mesh, self.sets, self.motion = mesh, sets, motion
        self._parts = [part for m in sets if "K" in m.names for part in self._of(m)]

    def _of(self, m: ElementMatrices):
        for at, matrices in m.nominal():
            nodes = m.elements.nodes[at]
            dofs = (6 * nodes[:, :, None] + np.arange(6)).reshape(len(nodes), -1)
            places = self.mesh.coordinates[nodes]
            body = np.concatenate([arm(x - places[:, 0]) for x in np.moveaxis(places, 1, 0)], axis=1)
            parallel = np.broadcast_to(np.tile(np.eye(6), (nodes.shape[1], 1)), body.shape)
            K = matrices["K"]
            yield K, dofs, _free(K, body) if (_free(K, body) != 0).any() else _free(K, parallel)

    def energies(self, q: np.ndarray) -> np.ndarray:
        """q'Kq (k, k) for motions q (n, k)."""
        u, found = self.motion.apply(q), np.zeros((q.shape[1], q.shape[1]))
        for K, dofs, rigid in self._parts:
            change = u[dofs] - rigid @ u[dofs[:, :6]]
            found += np.einsum("eik,eil->kl", change, K @ change, optimize=True)
        return found


def _free(K: np.ndarray, motions: np.ndarray) -> np.ndarray:
    """Those of the motions (e, d, 6) of an element on which K (e, d, d) does nothing; the others are set to 0."""
    size = np.abs(K) @ np.abs(motions)
    held = (np.abs(K @ motions) > 1e-10 * size).any(axis=1, keepdims=True)
    return np.where(held, 0.0, motions)


def _parts(mesh: Mesh) -> list[np.ndarray]:
    """Nodes of each part that elements and links join, those without any left out."""
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    pairs = [e.nodes[:, [i, i + 1]] for e in mesh.elements for i in range(e.nodes.shape[1] - 1)]
    pairs += [np.array([[link.independent, link.dependent]]) for link in mesh.links]
    pairs = np.concatenate([*pairs, np.zeros((0, 2), int)])
    k = len(mesh.node_ids)
    joined = coo_array((np.ones(len(pairs)), (pairs[:, 0], pairs[:, 1])), shape=(k, k))
    count, part = connected_components(joined, directed=False)
    order = np.argsort(part, kind="stable")
    return np.split(order, np.searchsorted(part[order], np.arange(1, count)))


def _rigid(
    mesh: Mesh, nodes: np.ndarray, motion: Motion, strain: _Strain, scale: np.ndarray, attached: np.ndarray
) -> np.ndarray:
    """Orthonormal rigid motions (n, r) of one part, times `scale`, that nothing resists."""
    body = np.zeros((len(mesh.node_ids), 6, 6))
    body[nodes] = arm(mesh.coordinates[nodes] - mesh.coordinates[nodes].mean(axis=0))
    full = np.concatenate([body.reshape(-1, 6), np.zeros((len(motion.counts) - 6 * len(mesh.node_ids), 6))])
    q = full[motion.places]
    q[attached] = 0.0
    Q, size, _ = np.linalg.svd(q * scale[:, None], full_matrices=False)
    Q = Q[:, size > 1e-9 * size.max(initial=1e-300)]
    if not Q.size:
        return Q
    energy, combination = np.linalg.eigh(strain.energies(Q / scale[:, None]))
    return Q @ combination[:, np.abs(energy) < _NONE]


def _lowest(K: Matrix, scale: np.ndarray, rigid: np.ndarray) -> np.ndarray:
    """The softest motions (n, k) in the units of `scale`, orthogonal to the rigid ones."""
    n = len(scale)
    if not is_sparse(K):
        w, V = np.linalg.eigh(K / np.outer(scale, scale))
        V = V[:, np.abs(w) < 1e-8]
        return V - rigid @ (rigid.T @ V)
    from scipy.sparse import diags_array

    S = diags_array(1 / scale) @ K @ diags_array(1 / scale)
    factor = definite_factor(S + _SHIFT * diags_array(np.ones(n)))
    V = np.random.default_rng(2).standard_normal((n, min(_BLOCK, n)))
    for _ in range(_PASSES):
        V = np.linalg.qr(V - rigid @ (rigid.T @ V))[0]
        V = factor.solve(V)
    return np.linalg.qr(V - rigid @ (rigid.T @ V))[0]


def definite_factor(matrix: Matrix):
    """Factors of a sparse symmetric positive definite matrix."""
    from scipy.sparse import csc_array
    from scipy.sparse.linalg import splu

    return splu(csc_array(matrix), permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options={"SymmetricMode": True})


def _most(mesh: Mesh, motion: Motion, q: np.ndarray) -> tuple[tuple[int, int], ...]:
    """(node, direction) of the directions that move most, rotations by the size of the mesh."""
    size = np.linalg.norm(np.ptp(mesh.coordinates, axis=0)) or 1.0
    u = np.abs(motion.apply(q)[: 6 * len(mesh.node_ids)]).reshape(-1, 6) * np.repeat([1.0, size], 3)
    order = np.argsort(-u.ravel(), kind="stable")[:6]
    order = order[u.ravel()[order] > 0.3 * u.max()]
    return tuple((int(mesh.node_ids[r // 6]), int(r % 6)) for r in order)
