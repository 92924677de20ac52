"""Error in the constitutive relation (Ladeveze and Reynier 1989): a picture of where the stiffness of a model is wrong.

A measured shape is expanded to u, and p = K^-1 (K - lambda M) u is what its strains lack of the strains that its inertia forces
would cause. Of all u the one is taken that minimises

    p'Kp + |W (y - S u)|^2 / alpha,    K p = (K - lambda M) u

with alpha such that it misses y by as much as the accuracies let expect (Morozov 1966). Stationarity makes p the response to forces
at the sensors: p = R(lambda) S'W c, (G + alpha) c = W y, G = W S R K R S' W, R = (K - lambda M)^-1. The energy p'Kp lies where
stiffness is wrong; an error of mass, too, is seen as one of stiffness.
"""

from collections.abc import Iterator

import numpy as np

from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.localise.matching import shapes
from mouse_cli.diagnosis.search.fit import Fit
from mouse_cli.model.arrays import Matrix
from mouse_cli.model.diagnosis import EnergyMap, Site
from mouse_cli.model.mesh import ElementSet
from mouse_cli.terms.bound_properties import BoundProperties, nominal_properties
from mouse_cli.terms.elements import Layout, registry

_POLE = 1e-6  # least distance of lambda from an eigenvalue, and least eigenvalue, relative to lambda
_SPAN, _HALVINGS = 30.0, 60  # decades of alpha
_ROUNDING = 1e-9  # of the largest stiffness, below which a spring is none
_BLOCK = 4096  # elements worked on at a time


def energy_map(one: Fit) -> EnergyMap | None:
    """Shares of elements, else of springs or nodes; each mode counts by its relative error. None where no shape tells anything."""
    base, measured = one.model.base, shapes(one.model.base)
    found = [
        _strains(one, lam, weight, y)
        for lam, weight, y in zip(measured.eigenvalue, measured.weight.T, measured.y.T, strict=True)
    ]
    error = np.array([size for _, size in found])
    if not error.any():
        return None
    P = base.V @ np.stack([p for p, _ in found], axis=1)
    theta = base.parameters(one.point.x[: one.model.k])
    sites, energy = _in_elements(base, theta, P) if base.motion is not None else _in_matrices(base, theta, P)
    if not energy.sum() > 0:
        return None
    return EnergyMap(tuple(sites), energy / energy.sum(), base.data.test.number[measured.modes], error)


def _strains(one: Fit, lam: float, weight: np.ndarray, y: np.ndarray) -> tuple[np.ndarray, float]:
    """p (r,) of one mode over the root of u'Ku, and p'Kp / u'Ku; y (s,) and weight (s,) over standard deviations."""
    r, X = one.model.base.r, one.point.X
    values = np.maximum(one.point.eigenvalues, _POLE * lam)
    apart = values - lam
    apart = np.where(np.abs(apart) < _POLE * lam, np.where(apart < 0, -_POLE, _POLE) * lam, apart)
    H = (weight[:, None] * one.point.seen)[weight > 0]
    g, U = np.linalg.eigh((H * (values / apart**2)) @ H.T)
    g, part = np.maximum(g, 0.0), U.T @ y[weight > 0]
    if part @ part <= len(part):
        return np.zeros(r), 0.0
    pull = H.T @ (U @ (part / (g + _alpha(g, part))))
    p, u = pull / apart, pull * values / apart**2
    strain = float(values @ u**2)
    return X[:r] @ p / np.sqrt(strain), float(values @ p**2) / strain


def _alpha(g: np.ndarray, part: np.ndarray) -> float:
    """alpha with |alpha (g + alpha)^-1 part|^2 as large as the number of data."""
    low, high = np.log10(g.max()) - _SPAN / 2, np.log10(g.max()) + _SPAN / 2
    for _ in range(_HALVINGS):
        middle = 0.5 * (low + high)
        left = 10**middle / (g + 10**middle) * part
        low, high = (low, middle) if left @ left > len(part) else (middle, high)
    return 10**low


def _in_elements(base: Reduced, theta: np.ndarray, P: np.ndarray) -> tuple[list[Site], np.ndarray]:
    """Elements that have stiffness, and p'K_e p of each, over all modes."""
    mesh, sites, energy = base.problem.mesh, [], []
    u = base.motion.apply(P)[: 6 * len(mesh.node_ids)].reshape(len(mesh.node_ids), 6, -1)
    for number, elements in enumerate(mesh.elements):
        for members, K in _stiffness(base, number, elements, theta):
            own = u[elements.nodes[members]].reshape(len(members), K.shape[1], -1)
            energy.append(np.einsum("eim,eij,ejm->e", own, K, own, optimize=True))
            middles = mesh.coordinates[elements.nodes[members]].mean(axis=1).tolist()
            names = elements.ids[members].tolist()
            sites += [Site("element", (i,), tuple(at), f"element {i}") for i, at in zip(names, middles, strict=True)]
    return sites, np.concatenate([*energy, np.zeros(0)])


def _stiffness(
    base: Reduced, number: int, elements: ElementSet, theta: np.ndarray
) -> Iterator[tuple[np.ndarray, np.ndarray]]:
    """Members (e,) of element set `number` and their elastic stiffness (e, d, d) at theta (p,), block by block."""
    kind = registry()[elements.type]
    options = {key: option.default for key, option in kind.options.items()} | elements.options
    layout = Layout(base.problem.mesh.coordinates[elements.nodes], options)
    p = {name: np.array(value, float) for name, value in nominal_properties(kind, elements, layout).items()}
    own = tuple(b for b in base.problem.bindings if b.set == number)
    if own:
        bound = BoundProperties(kind, elements, layout, own)
        for name, value in bound.at(theta)[0].items():
            p[name][bound.members] = value
    for first in range(0, len(elements), _BLOCK):
        members = np.arange(first, min(first + _BLOCK, len(elements)))
        K = kind.matrices(layout.of(members), {name: value[members] for name, value in p.items()}).get("K")
        if K is not None:
            yield members, K


def _in_matrices(base: Reduced, theta: np.ndarray, P: np.ndarray) -> tuple[list[Site], np.ndarray]:
    """The springs that K at theta (p,) is made of, else nodes."""
    K, _ = base.assembly.matrices(theta)
    return _in_springs(base, K, P) or _at_nodes(base, K, P)


def _in_springs(base: Reduced, K: Matrix, P: np.ndarray) -> tuple[list[Site], np.ndarray] | None:
    """Springs between degrees of freedom and to the ground, and p'K_e p of each; None where K is not made of such springs."""
    from scipy.sparse import coo_array

    entries, labels = coo_array(K), base.problem.structure.labels
    i, j, k = entries.row, entries.col, entries.data
    ground, size = np.asarray(K.sum(axis=1)).ravel(), np.abs(k).max()
    if (k[i != j] > _ROUNDING * size).any() or (ground < -_ROUNDING * size).any():
        return None
    pair, held = (i < j) & (k < 0), np.flatnonzero(ground > _ROUNDING * size)
    i, j = i[pair], j[pair]
    sites = [
        Site("dof", (labels[a], labels[b]), None, f"between degrees of freedom {labels[a]} and {labels[b]}")
        for a, b in zip(i, j, strict=True)
    ]
    sites += [Site("dof", (labels[a],), None, f"between degree of freedom {labels[a]} and the ground") for a in held]
    between = -k[pair] * np.sum((P[i] - P[j]) ** 2, axis=1)
    return sites, np.concatenate([between, ground[held] * np.sum(P[held] ** 2, axis=1)])


def _at_nodes(base: Reduced, K: Matrix, P: np.ndarray) -> tuple[list[Site], np.ndarray]:
    """Nodes, or degrees of freedom without one, and the size of the work of the forces K p there on the motion p."""
    structure = base.problem.structure
    work = np.einsum("nm,nm->n", P, K @ P)
    at, labels = structure.geometry, structure.labels
    alone = np.arange(structure.n) if at is None else np.flatnonzero(at.node < 0)
    sites = [Site("dof", (labels[i],), None, f"degree of freedom {labels[i]}") for i in alone]
    if at is None:
        return sites, np.abs(work)
    nodes = np.unique(at.node[at.node >= 0])
    names, places = at.node_ids[nodes].tolist(), at.coordinates[nodes].tolist()
    of_nodes = [Site("node", (i,), tuple(x), f"node {i}") for i, x in zip(names, places, strict=True)]
    total = np.bincount(at.node[at.node >= 0], work[at.node >= 0], minlength=nodes.max(initial=-1) + 1)[nodes]
    return of_nodes + sites, np.abs(np.concatenate([total, work[alone]]))
