"""Motions that nothing resists: those of rigid parts, which may be meant, and mechanisms, which are faults."""

import numpy as np

from mouse_cli.model.arrays import Matrix, is_sparse
from mouse_cli.model.mesh import Mesh
from mouse_cli.terms.constraints import Motion
from mouse_cli.terms.element_matrices import ElementMatrices
from mouse_cli.terms.elements._axes import arm
from mouse_cli.terms.faults import Mechanism, Remark, floating
from mouse_cli.terms.joined import parts

LARGEST = 200_000  # degrees of freedom; larger models are not searched
_BLOCK, _PASSES, _SHIFT = 8, 6, 1e-12


def search(
    mesh: Mesh, sets: list[ElementMatrices], motion: Motion, K: Matrix, held: np.ndarray, attached: np.ndarray
) -> tuple[Remark, ...]:
    """The parts that may move as rigid bodies. Raises Mechanism for any other motion without stiffness.

    Energies are summed element by element from deformations, which tells none from little where K alone cannot: the lowest
    frequencies of a long chain of beams are below the rounding of K. held (r,): mask of the directions of nodes that are
    supported, or have stiffness, and cannot move. attached (n,): mask of the degrees of freedom of imported matrices, which may
    hold what they touch and are not looked into.
    """
    if not motion.n or motion.n > LARGEST:
        return ()
    scale = np.sqrt(np.abs(K.diagonal()))
    scale[scale == 0] = 1.0
    strain, held = _Strain(mesh, sets, motion), held.copy()
    held[motion.places[attached]] = True
    remarks, rigid = [], [np.zeros((motion.n, 0))]
    for nodes in _parts(mesh):
        Q = _rigid(mesh, nodes, motion, strain, scale, held)
        if Q.shape[1]:
            rigid.append(Q)
            remarks.append(floating(tuple(sorted(mesh.node_ids[nodes].tolist())), Q.shape[1]))
    lost = _lowest(K, scale, np.hstack(rigid))
    lost[attached] = 0.0
    lost = lost[:, np.linalg.norm(lost, axis=0) > 0.1]
    if lost.shape[1]:
        lost = strain.without(lost / np.linalg.norm(lost, axis=0), scale)
        if lost.shape[1]:
            raise Mechanism(_most(mesh, motion, lost[:, 0] / scale))
    return tuple(remarks)


class _Strain:
    """Energies of motions: rigid motion about its first node is taken out of each element before K acts on the rest.

    none: energy of a motion of unit size, in units of the diagonal of K, that counts as none; well below that of the lowest
    bending mode of a chain of all k nodes, of order (pi/k)^4/50, and above rounding.
    """

    def __init__(self, mesh: Mesh, sets: list[ElementMatrices], motion: Motion):
        self.mesh, self.sets, self.motion = mesh, sets, motion
        self.none = min(max(1e-4 / len(mesh.node_ids) ** 4, 1e-22), 1e-15)
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

    def without(self, Q: np.ndarray, scale: np.ndarray) -> np.ndarray:
        """Combinations (n, r) of the motions Q / scale that nothing resists.

        Their energies are computed anew: those of the first sum have the rounding of the largest among them.
        """
        if not Q.size:
            return Q
        Q = Q @ np.linalg.eigh(self.energies(Q / scale[:, None]))[1]
        energy = np.abs(self.energies(Q / scale[:, None]).diagonal())
        return Q[:, energy < self.none]


def _free(K: np.ndarray, motions: np.ndarray) -> np.ndarray:
    """Those of the motions (e, d, 6) of an element on which K (e, d, d) does nothing; the others are set to 0."""
    size = np.abs(K) @ np.abs(motions)
    held = (np.abs(K @ motions) > 1e-10 * size).any(axis=1, keepdims=True)
    return np.where(held, 0.0, motions)


def _parts(mesh: Mesh) -> list[np.ndarray]:
    """Nodes of each part that elements and links join, those without any left out."""
    pairs = [e.nodes[:, [i, i + 1]] for e in mesh.elements for i in range(e.nodes.shape[1] - 1)]
    pairs += [np.array([[link.independent, link.dependent]]) for link in mesh.links]
    pairs = np.concatenate([*pairs, np.zeros((0, 2), int)])
    part = parts(pairs, len(mesh.node_ids))
    order = np.argsort(part, kind="stable")
    return np.split(order, np.searchsorted(part[order], np.arange(1, part.max(initial=0) + 1)))


def _rigid(
    mesh: Mesh, nodes: np.ndarray, motion: Motion, strain: _Strain, scale: np.ndarray, held: np.ndarray
) -> np.ndarray:
    """Rigid motions (n, r) of one part, times `scale`, that neither supports nor springs to the ground resist."""
    k = len(mesh.node_ids)
    centred = mesh.coordinates[nodes] - mesh.coordinates[nodes].mean(axis=0)
    size = np.abs(centred).max(initial=0.0) or 1.0
    body = np.zeros((k, 6, 6))
    body[nodes] = arm(centred) * np.repeat([1.0, 1 / size], 3)
    full = np.concatenate([body.reshape(-1, 6), np.zeros((len(motion.counts) - 6 * k, 6))])
    _, sizes, ways = np.linalg.svd(np.concatenate([full[held], np.zeros((6, 6))]), full_matrices=False)
    q = full[motion.places] @ ways[sizes <= 1e-9 * max(1.0, sizes.max())].T
    Q, sizes, _ = np.linalg.svd(q * scale[:, None], full_matrices=False)
    return strain.without(Q[:, sizes > 1e-9 * sizes.max(initial=1e-300)], scale)


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
