"""Where members of a mesh end, where masses are, and what is joined."""

import numpy as np

from mouse_cli.model.mesh import Mesh

STRAIGHT = 0.999  # cosine from which on one member continues another


def ends(mesh: Mesh) -> np.ndarray:
    """Nodes (indices) of two-node elements at which not just one straight member passes: held or linked, it ends."""
    arms: dict[int, list[np.ndarray]] = {}
    for elements in mesh.elements:
        if elements.nodes.shape[1] == 2:
            along = mesh.coordinates[elements.nodes[:, 1]] - mesh.coordinates[elements.nodes[:, 0]]
            bent = np.full(len(elements), elements.type != "beam")
            along[bent] = 0.0  # only beams carry a load past a node
            for (a, b), vector in zip(elements.nodes.tolist(), along, strict=True):
                arms.setdefault(a, []).append(vector), arms.setdefault(b, []).append(-vector)
    held = {
        *mesh.standing[:, 0].tolist(),
        *(node for link in mesh.links for node in (link.independent, link.dependent)),
    }
    return np.array(sorted(node for node, own in arms.items() if node in held or not _passes(own)), int)


def laden(mesh: Mesh) -> np.ndarray:
    """Nodes (indices) of point masses: floors of a tower, machines on a beam."""
    return np.unique([node for each in mesh.elements if each.type == "mass" for node in each.nodes[:, 0]]).astype(int)


def _passes(arms: list[np.ndarray]) -> bool:
    """Whether two elements alone meet and continue one another."""
    if len(arms) != 2:
        return False
    size = np.linalg.norm(arms[0]) * np.linalg.norm(arms[1])
    return bool(size > 0 and arms[0] @ arms[1] < -STRAIGHT * size)


def joined(mesh: Mesh) -> set[tuple[int, int]]:
    """Nodes (i < j) that an element or a rigid link joins."""
    found = {tuple(sorted((link.independent, link.dependent))) for link in mesh.links}
    for elements in mesh.elements:
        if elements.nodes.shape[1] == 2:
            found |= {tuple(pair) for pair in np.sort(elements.nodes, axis=1).tolist()}
    return found
