"""Nodes of a large model where a mass explains most, and those around them: what acts at a node acts along all translations."""

import numpy as np

from mouse_cli.diagnosis.likelihoods.modal.model import Model, modes_of
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.localise.energy_map import energy_map
from mouse_cli.diagnosis.search.fit import Fit, fit
from mouse_cli.model.geometry import Geometry

_SHARES = 0.003, 0.01, 0.03, 0.1, 0.3  # masses that are tried, over that of the model
_BEST = 12  # nodes that are taken
_CENTRES, _AROUND = 2, 8  # of these, the first so many are looked around, at so many nodes each
_SPREAD = 40  # nodes all over the structure
_TELLS = 0.5  # share of the misfit that a mass has to explain for that
MOST = 3 * (_BEST + _CENTRES * _AROUND)  # degrees of freedom at most


def heavier(model: Reduced, places: np.ndarray) -> np.ndarray:
    """The other translations of the best nodes of `places`, of those where stiffness and shapes disagree most, and of some all over
    the structure, and those around the first; none where nodes are not known.

    A look at several masses at each node, the deck's parameters following to first order. A large mass on a slender part has modes
    of its own, which no force on the model as it is makes.
    """
    at, update = model.problem.structure.geometry, fit(Model(model), np.zeros(0))
    if at is None or update is None or not (at.node[places] >= 0).any():
        return np.zeros(0, int)
    nodes = np.unique(np.concatenate([at.node[places][at.node[places] >= 0], _disagreeing(update, at), _spread(at)]))
    left = np.array([_left(update, model.V[_translations(at, [node])]) for node in nodes])
    best = nodes[np.argsort(left, kind="stable")[:_BEST]].tolist()
    if left.min() < (1 - _TELLS) * update.misfit:
        best += [node for centre in best[:_CENTRES] for node in _around(at, centre)]
    return np.setdiff1d(_translations(at, best), places)


def _spread(at: Geometry) -> np.ndarray:
    """Nodes (indices) that move, each the farthest from those before it."""
    nodes = np.unique(at.node[at.node >= 0])
    x = at.coordinates[nodes]
    found = [int(np.argmax(np.linalg.norm(x - x.mean(axis=0), axis=1)))]
    gap = np.full(len(x), np.inf)
    while len(found) < min(_SPREAD, len(nodes)):
        gap = np.minimum(gap, np.linalg.norm(x - x[found[-1]], axis=1))
        found.append(int(np.argmax(gap)))
    return nodes[found]


def _disagreeing(update: Fit, at: Geometry) -> np.ndarray:
    """Nodes (indices) where stiffness and shapes disagree most; none where that is told of parts."""
    found = energy_map(update)
    if found is None:
        return np.zeros(0, int)
    most = [found.sites[i] for i in np.argsort(-found.share, kind="stable")[:_BEST]]
    ids = [site.ids[0] for site in most if site.kind == "node"]
    return np.flatnonzero(np.isin(at.node_ids, ids))


def _left(update: Fit, B: np.ndarray) -> float:
    """The least misfit with a mass on B (3, r)."""
    model, base, x = update.model, update.model.base, update.point.x
    T = model.jacobian(update.point)
    H, least = T.T @ T + np.eye(len(x)), np.inf
    K, M = base.matrices(x)
    for share in _SHARES:
        found = modes_of(K.copy(), M + share * base.total_mass * B.T @ B)
        at = model.paired(x, *found, np.zeros_like(base.sensing)) if np.isfinite(found[0]).all() else None
        if at is not None:
            pull = T.T @ at.residual - x
            least = min(least, at.chi2 + float(x @ x - pull @ np.linalg.solve(H, pull)))
    return least


def _translations(at: Geometry, nodes: list[int]) -> np.ndarray:
    """Their degrees of freedom."""
    return np.flatnonzero(np.isin(at.node, nodes) & (at.direction < 3))


def _around(at: Geometry, centre: int) -> list[int]:
    """The nearest nodes that move."""
    free = np.unique(at.node[at.node >= 0])
    gap = np.linalg.norm(at.coordinates[free] - at.coordinates[centre], axis=1)
    return free[np.argsort(gap, kind="stable")[1 : 1 + _AROUND]].tolist()
