"""Axial forces under gravity (P-delta): they follow the nominal properties, whatever parameters say later."""

from collections.abc import Callable

import numpy as np

from mouse_cli.model.arrays import Matrix, is_sparse
from mouse_cli.model.mesh import Mesh
from mouse_cli.terms.constraints import Motion
from mouse_cli.terms.element_matrices import ElementMatrices
from mouse_cli.terms.faults import NoLoadPath
from mouse_cli.terms.joined import parts
from mouse_cli.terms.mechanisms import definite_factor

_SHIFT = 1e-13  # of the diagonal of K, so that motions that gravity does no work on need no support
_BALANCED = 1e-6  # share of the weight that may stay unbalanced
_ROUNDS = 8  # solutions at most, each of what the ones before left unbalanced


def axial_forces(mesh: Mesh, sets: list[ElementMatrices], motion: Motion, K: Matrix) -> dict[int, np.ndarray]:
    """Tension (e,) of the element sets, by number, that carry weight: by linear statics, and storeys by what they carry.

    The weight is that of all elements and point masses of the mesh, not of imported matrices. Raises NoLoadPath.
    """
    load = _weights(mesh, sets)
    found = {}
    if any(m.kind.axial is not None for m in sets):
        u = motion.apply(displacements(K, motion.load(load)))
        for i, m in enumerate(sets):
            tension = m.tension(u[_dofs(m)])
            if tension is not None:
                found[i] = tension
    stacked = [i for i, m in enumerate(sets) if m.kind.stacked]
    return found | _stacks(mesh, sets, stacked, motion, load)


def _dofs(m: ElementMatrices) -> np.ndarray:
    return (6 * m.elements.nodes[:, :, None] + np.arange(6)).reshape(len(m.elements), -1)


def _weights(mesh: Mesh, sets: list[ElementMatrices]) -> np.ndarray:
    """Loads on all directions of all nodes: M times the acceleration."""
    load = np.zeros(6 * len(mesh.node_ids))
    for m in sets:
        dofs = _dofs(m)
        field = np.tile(np.concatenate([mesh.gravity, np.zeros(3)]), m.elements.nodes.shape[1])
        for at, matrices in m.nominal():
            if "M" in matrices:
                np.add.at(load, dofs[at], matrices["M"] @ field)
    return load


def displacements(K: Matrix, f: np.ndarray) -> np.ndarray:
    """K^-1 f. Raises NoLoadPath where K does not resist f.

    What the shift leaves unbalanced is put on again: less each time, but for what nothing resists. It is much on fine meshes, where
    the diagonal is many orders of magnitude above the stiffness of the whole.
    """
    solve, u = _shifted(K), np.zeros(len(f))
    for _ in range(_ROUNDS):
        u = u + solve(f - K @ u)
        if np.linalg.norm(K @ u - f) <= _BALANCED * np.linalg.norm(f):
            return u
    raise NoLoadPath("nothing supports the structure against gravity")


def _shifted(K: Matrix) -> Callable[[np.ndarray], np.ndarray]:
    """Solves with K + _SHIFT diag(K)."""
    if is_sparse(K):
        from scipy.sparse import diags_array

        return definite_factor(K + _SHIFT * diags_array(K.diagonal())).solve
    moved = K + _SHIFT * np.diag(K.diagonal())
    return lambda f: np.linalg.solve(moved, f)


def _stacks(
    mesh: Mesh, sets: list[ElementMatrices], stacked: list[int], motion: Motion, load: np.ndarray
) -> dict[int, np.ndarray]:
    """Tension (e,) of the sets of storeys: the weight of the side without support, shared by storeys of the same two floors."""
    if not stacked:
        return {}
    own = np.concatenate([np.sort(sets[i].elements.nodes, axis=1) for i in stacked])
    others = [m.elements.nodes[:, :2] for i, m in enumerate(sets) if i not in stacked and m.elements.nodes.shape[1] > 1]
    others += [np.array([[link.independent, link.dependent]]) for link in mesh.links]
    floors, number, many = np.unique(own, axis=0, return_inverse=True, return_counts=True)
    edges = np.concatenate([floors, *others])
    grounded = motion.counts[: 6 * len(mesh.node_ids)].reshape(-1, 6).sum(axis=1) == 0
    size = np.linalg.norm(mesh.gravity)
    down = mesh.gravity / size if size else mesh.gravity
    weight = load.reshape(-1, 6)[:, :3] @ down
    force = np.array([_carried(mesh, edges, i, grounded, weight, down) for i in range(len(floors))]) / many
    first = np.cumsum([0] + [len(sets[i].elements) for i in stacked])
    tension = force[number.ravel()]
    return {i: tension[first[j] : first[j + 1]] for j, i in enumerate(stacked)}


def _carried(
    mesh: Mesh, edges: np.ndarray, cut: int, grounded: np.ndarray, weight: np.ndarray, down: np.ndarray
) -> float:
    """Tension in edge number `cut`: weight of the nodes that lose the ground with it, positive where they hang."""
    part = parts(np.delete(edges, cut, axis=0), len(grounded))
    ends = edges[cut]
    held = [bool(grounded[part == part[end]].any()) for end in ends]
    if held[0] == held[1]:
        names = tuple(mesh.node_ids[ends].tolist())
        why = "both floors are supported otherwise" if held[0] else "neither floor is supported"
        raise NoLoadPath(f"the weight on the storey between nodes {names[0]} and {names[1]} is not known: {why}", names)
    base, far = ends if held[0] else ends[::-1]
    along = mesh.coordinates[far] - mesh.coordinates[base]
    return float(weight[part == part[far]].sum() * (along @ down) / np.linalg.norm(along))
