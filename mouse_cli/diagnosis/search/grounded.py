"""Springs to the ground said in two ways: a strut from a held node, and a spring from the place where it ends to the surroundings.

Along the strut they are one matrix. Across it a model mostly feels so little that the data do not tell them apart.
"""

import numpy as np

from mouse_cli.diagnosis.effects.change import PLACE
from mouse_cli.diagnosis.gates import SAME_SITE
from mouse_cli.diagnosis.likelihoods.modal.scales import span
from mouse_cli.diagnosis.search.fit import Fit

STRUT, SPRINGS = "brace", frozenset({"ground-spring", "inclined-spring"})  # keys of mechanisms
_WITHIN = 2.0  # sd of a place


def one_tie(one: Fit, other: Fit) -> bool:
    """Whether one of two fits is a strut from a held node, and the other a spring to the ground where that ends."""
    strut, spring = sorted((one, other), key=lambda fit: _key(fit) != STRUT)
    if _key(strut) != STRUT or _key(spring) not in SPRINGS:
        return False
    mesh, site = strut.model.base.problem.mesh, spring.sites[0]
    if mesh is None or len(strut.sites[0].ids) != 2:
        return False
    nodes = np.flatnonzero(np.isin(mesh.node_ids, strut.sites[0].ids))
    held = np.isin(nodes, mesh.standing[mesh.standing[:, 1] < 3, 0])
    if held.sum() != 1:
        return False
    end = nodes[~held][0]
    if site.position is None:  # anywhere along a row of members that is stiff along itself
        return site.kind == "element" and any(end in own.nodes[np.isin(own.ids, site.ids)] for own in mesh.elements)
    off = np.linalg.norm(mesh.coordinates[end] - site.position)
    return bool(off <= max(SAME_SITE * span(spring.model.base), _WITHIN * _sd(spring)))


def _key(fit: Fit) -> str | None:
    """Key of its mechanism, where it is one alone."""
    return fit.recipes[0].candidate.key if len(fit.recipes) == 1 else None


def _sd(spring: Fit) -> float:
    """Posterior sd (m) of its place along a line; 0 of one at a node."""
    at = [i for i, unknown in enumerate(spring.recipes[0].unknowns) if unknown.name == PLACE]
    own = spring.model.k + np.array(at, int)
    return float(np.sqrt(spring.covariance[own, own].max(initial=0.0)))
