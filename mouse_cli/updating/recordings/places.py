"""Where a local force may act: between two degrees of freedom that are linked or measured, and from each to the ground."""

from collections.abc import Callable, Iterator
from itertools import combinations

import numpy as np

from mouse_cli.model.diagnosis import Site
from mouse_cli.model.problem import Problem
from mouse_cli.terms.assembly import assembly
from mouse_cli.terms.laws import Scale
from mouse_cli.updating.recordings.acting import Place
from mouse_cli.updating.recordings.free_force import Spectrum
from mouse_cli.updating.recordings.uncertain import links

# Of the stiffness of the whole structure, of which that of a mass on a few springs is so many times at most
_WHOLE = 5.0
_MOST_APART = 10  # pairs of measured degrees of freedom without a link that are looked at: those of five; of unmeasured tilts
_EQUAL = 0.1  # of the logarithm of an inertia, up to which it is that of a disc about another diameter


def motions(problem: Problem, sensed: np.ndarray) -> Iterator[tuple[Site, np.ndarray, float]]:
    """Site, motion B (n,) and the stiffness that links it. sensed (n,): mask of what is driven or measured."""
    labels, n = problem.structure.labels, problem.structure.n
    bends = any(_turns(label) for label in labels)  # entries of its K are no springs by themselves
    K, _ = assembly(problem).matrices(problem.prior.mean)
    found = links(K)
    pairs = (
        []
        if found is None or bends
        else [(np.flatnonzero(b), b, k) for b, k in zip(found.B.T, found.values, strict=True)]
    )
    grounded = {ends[0]: k for ends, _, k in pairs if len(ends) == 1}
    for i in range(n):
        if not _turns(labels[i]):
            text = f"between {_named(labels[i])} and the ground"
            yield Site("dof", (labels[i],), text=text), _unit(n, i), grounded.get(i, 0.0)
    linked = {tuple(ends): k for ends, _, k in pairs if len(ends) == 2}
    along = lambda pairs: [(i, j) for i, j in pairs if _alike(labels[i], labels[j])]
    apart = [pair for pair in along(combinations(np.flatnonzero(sensed).tolist(), 2)) if pair not in linked]
    near = [] if len(apart) > _MOST_APART else apart  # towers that pound, a cable between floors
    for i, j in along(linked) + near:
        text = f"between {_named(labels[i])} and {_named(labels[j])}"
        yield Site("dof", (labels[i], labels[j]), text=text), _unit(n, j) - _unit(n, i), linked.get((i, j), 0.0)


def bodies(problem: Problem) -> Iterator[tuple[Site, list[int]]]:
    """Site and degrees of freedom of bodies that translate along several axes: their inertia acts along all of them."""
    found: dict[str, list[int]] = {}
    for i, label in enumerate(problem.structure.labels):
        if not label.isdigit() and not _turns(label):
            found.setdefault(label[:-2], []).append(i)
    for node, own in found.items():
        if len(own) > 1:
            yield Site("node", (int(node) if node.isdigit() else node,), text=f"node {node}"), own


def planes(problem: Problem, sensed: np.ndarray) -> Iterator[tuple[Site, int, int]]:
    """Site and degrees of freedom of pairs of directions of one body: all of which one at least is driven or measured, and of
    others a few that are most like the tilts of a disc, which nobody measures: of the same inertia, and of the largest.

    Numbers of a matrix model have no directions: two of them are of different planes where neither stiffness nor mass joins them.
    """
    labels = problem.structure.labels
    pairs = list(_crossing(problem))
    inertia = assembly(problem).matrices(problem.prior.mean)[1].diagonal()
    size = lambda pair: np.log(np.maximum(inertia[list(pair)], 1e-300))
    as_disc = lambda pair: (not _turns(labels[pair[0]]), bool(np.ptp(size(pair)) > _EQUAL), -size(pair).sum())
    unseen = sorted((pair for pair in pairs if not sensed[list(pair)].any()), key=as_disc)[:_MOST_APART]
    for i, j in pairs:
        if sensed[i] or sensed[j] or (i, j) in unseen:
            text = f"between {_named(labels[i])} and {_named(labels[j])}"
            yield Site("dof", (labels[i], labels[j]), text=text), i, j


def _crossing(problem: Problem) -> Iterator[tuple[int, int]]:
    """Pairs of directions of one body, or of different planes of a matrix model."""
    labels, part = problem.structure.labels, _parts(problem)
    for i, j in combinations(range(len(labels)), 2):
        if labels[i].isdigit() and labels[j].isdigit():
            if part[i] != part[j]:
                yield i, j
        elif labels[i][:-2] == labels[j][:-2] and labels[i][-2:-1] == labels[j][-2:-1]:
            yield i, j


def _parts(problem: Problem) -> np.ndarray:
    """Number (n,) of the part of the model, joined by stiffness or mass, that each degree of freedom belongs to."""
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    K, M = assembly(problem).matrices(problem.prior.mean)
    return connected_components(abs(coo_array(K)) + abs(coo_array(M)), directed=False)[1]


def _turns(label: str) -> bool:
    return label[-2:-1] == "R"


def _alike(one: str, other: str) -> bool:
    """Whether two degrees of freedom move along the same line: the numbers of a matrix model may."""
    return not _turns(one) and (one[-2:] == other[-2:] or (one.isdigit() and other.isdigit()))


def _named(label: str) -> str:
    return f"degree of freedom {label}" if label.isdigit() else label


def places(
    problem: Problem, spectrum: Spectrum, basis: np.ndarray, band: tuple[float, float], sensed: np.ndarray
) -> list[Place]:
    """All of them, with the motion that the record has there. sensed (n,): mask of what is driven or measured."""
    found, scale, n = [], _scales(spectrum, basis.shape[1], band), problem.structure.n
    body = {i: site.text for site, own in bodies(problem) for i in own}
    for site, b, link in motions(problem, sensed):
        own = scale(basis.T @ b, link)
        if own is not None:
            ground = len(site.ids) == 1
            name = body.get(int(np.argmax(b)), "") if ground else ""
            found.append(Place(site, basis.T @ b, ground, own, b, whole=ground and not name, body=name))
    for site, own in bodies(problem):
        scales = [(i, one) for i in own if (one := scale(basis[i], 0.0)) is not None]
        if scales:  # those of the translation that moves most
            first, most = max(scales, key=lambda each: each[1].x)
            across = basis[[i for i, _ in scales if i != first]].T
            one = Place(site, basis[first], True, most, _unit(n, first), across=across, whole=True, body=site.text)
            found.append(one)
    for site, i, j in planes(problem, sensed):
        both = [one for one in (scale(basis[i], 0.0), scale(basis[j], 0.0)) if one is not None]
        if len(both) == 2:
            own = max(both, key=lambda one: one.stiffness * one.x / one.v)
            found.append(Place(site, basis[i], False, own, _unit(n, i), across=basis[j]))
    return found


def _scales(spectrum: Spectrum, m: int, band: tuple[float, float]) -> Callable[[np.ndarray, float], Scale | None]:
    """What a motion B (m,) with a link is like in the record; None where it has none.

    Force over motion is elastic or inertial, whichever is more: a mass that nothing holds has no B'KB.
    """
    from scipy.linalg import eigh

    model = spectrum.linear
    u = spectrum.motions(np.zeros((m, 0)))
    moved = [spectrum.derivative(u, order) for order in (0, 1, 2)]
    resonances, shapes = eigh(model.K, model.M)
    moving = resonances < (2 * np.pi * band[1]) ** 2

    def scale(B: np.ndarray, link: float) -> Scale | None:
        size = float(B @ B)
        x, v, a = (float((one @ B).std()) for one in moved)
        if size < 1e-24 or x == 0:
            return None
        stiffness, mass = (float(B @ matrix @ B) / size**2 for matrix in (model.K, model.M))
        step = spectrum.series.dt / spectrum.series.factor
        inertial, modal = mass * a / x, (B @ shapes) ** 2
        least = max(1 / float(modal @ (1 / np.maximum(resonances, 1e-9 * resonances.max() + 1e-30))), inertial)
        most = 1 / max(float(modal[moving].max(initial=0.0)), 1e-9 / mass)
        stiffness = max(stiffness, inertial)
        links = 2 * mass / step**2, mass * a, max(link, 0.0)
        return Scale(stiffness, mass, x, v, band, *links, min(_WHOLE * least, stiffness), max(most, mass))

    return scale


def _unit(n: int, i: int) -> np.ndarray:
    """The motion (n,) of degree of freedom number i alone."""
    found = np.zeros(n)
    found[i] = 1.0
    return found
