"""Where one force may act: along the lines of bars, at nodes, or at degrees of freedom of models without geometry."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from mouse_cli.diagnosis.effects.change import PLACE, Change, Recipe, Unknown, product, steps
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.sites.lines import Line, elements
from mouse_cli.model.diagnosis import Site
from mouse_cli.model.geometry import DIRECTIONS
from mouse_cli.model.problem import Problem
from mouse_cli.model.structure import Structure

_STILL = 0.02  # share of the largest motion in a measured mode below which a direction does not take part
_ALIKE = 0.01  # of the motion of a line: differences along it up to which it moves as one
_EACH = 6  # places to begin from on a line
_ALL = 300  # nodes or degrees of freedom that are looked at where nothing tells them apart


@dataclass(frozen=True)
class Points:
    """Places of one kind, and how they move. share: of all places, by which the prior is spread.

    motion(values): rows (d, r) of the displacement there, for the values of `unknown`, none of which for a single place.
    dofs: directions that they are along, or, in a model of matrices, degrees of freedom (from 0).
    """

    unknown: tuple[Unknown, ...]
    starts: np.ndarray
    motion: Callable[[np.ndarray], np.ndarray]
    site: Callable[[np.ndarray], Site]
    share: float
    dofs: tuple[int, ...] = ()


def all_motions(model: Reduced) -> list[Points]:
    """Places with all their translations: where a mass may sit."""
    found = _lines(model, None) + _nodes(model) if model.motion is not None else _dofs(model, together=True)
    return _shared(found)


def directions(model: Reduced) -> list[Points]:
    """Places with one direction each: where a spring to the ground may act."""
    if model.motion is None:
        return _shared(_dofs(model, together=False))
    found = []
    for d in range(3):
        found += _lines(model, d)
    return _shared(found + [point for node in _nodes(model) for point in _split(node)])


def in_all_directions(model: Reduced, suffix: str = "all directions alike") -> list[Points]:
    """Places that move along more than one axis, with all their translations; suffix: of the text of each place."""
    kept = set() if model.motion is None else set(model.problem.mesh.directions)
    places = all_motions(model) if len(kept & {0, 1, 2}) > 1 else []
    return [_together(point, kept, suffix) for point in places if len(kept.intersection(point.dofs)) > 1]


def _together(point: Points, kept: set[int], suffix: str) -> Points:
    rows = [i for i, d in enumerate(point.dofs) if d in kept]

    def site(values: np.ndarray) -> Site:
        here = point.site(values)
        return replace(here, text=f"{here.text}, {suffix}")

    dofs = tuple(point.dofs[i] for i in rows)
    return replace(point, site=site, dofs=dofs, motion=lambda values: point.motion(values)[rows])


def placed(
    candidate: Any,
    point: Points,
    sizes: tuple[Unknown, ...],
    starts: tuple[np.ndarray, ...],
    change: Callable[[np.ndarray, np.ndarray], Change],
    extend: Callable[..., Problem],
    own: int = 0,
) -> Recipe:
    """What acts at one of these places: values are those of `sizes`, then of the place.

    starts: values of each size to begin from. change(values of the sizes, B): for the motion B (d, r) of the place;
    extend(problem, point, values of the place, *values of the sizes): the deck with it.
    """
    t = len(sizes)
    return Recipe(
        candidate,
        (*sizes, *point.unknown),
        lambda values: change(values[:t], point.motion(values[t:])),
        product(*starts, *point.starts.T),
        lambda values: point.site(values[t:]),
        own,
        float(np.log(point.share)),
        lambda problem, values: extend(problem, point, values[t:], *values[:t]),
    )


def sized(
    candidate: Any,
    points: list[Points],
    size: Unknown,
    starts: tuple[int, int],
    change: Callable[[np.ndarray, np.ndarray], Change],
    extend: Callable[..., Problem],
) -> list[Recipe]:
    """What is proportional to one size, at each of `points`; starts: how many to begin from along a line, where each helps its
    neighbours, and at a single place.
    """
    many = lambda point: steps(size, starts[0] if point.unknown else starts[1])
    made = (placed(candidate, point, (size,), (many(point),), change, extend) for point in points)
    return [replace(one, linear=0) for one in made]


def _shared(found: list[Points]) -> list[Points]:
    total = sum(point.share for point in found) or 1.0
    return [Points(p.unknown, p.starts, p.motion, p.site, p.share / total, p.dofs) for p in found]


def _reach(model: Reduced) -> np.ndarray:
    """Coordinates (r,) weighed by how much the measured modes hold of them: the lowest, evenly."""
    count = model.low_modes(2)
    return (np.arange(model.r) < count).astype(float)


def wanted(model: Reduced) -> np.ndarray | None:
    """Mask of the nodes, or degrees of freedom of a model of matrices, that are worth looking at; None: all.

    Where no shape tells places apart, some all over a large model.
    """
    places, at = getattr(model, "places", None), model.problem.structure.geometry
    n = model.problem.structure.n
    if model.motion is not None:
        n = len(model.problem.mesh.node_ids)
        places = None if places is None else np.unique(at.node[places][at.node[places] >= 0])
    if places is None or (not len(places) and n <= _ALL):
        return None
    mask = np.zeros(n, bool)
    mask[places if len(places) else np.linspace(0, n - 1, _ALL).astype(int)] = True
    return mask


def _lines(model: Reduced, direction: int | None) -> list[Points]:
    bars = model.bars
    if bars is None:
        return []
    used, keep = _reach(model), wanted(model)
    runs = [run for run in bars.runs if keep is None or keep[bars.nodes[run.members]].any()]
    sizes = [np.abs(run.middles * used).max(axis=2) for run in runs]  # (bars, 3)
    largest, found = max((size.max() for size in sizes), default=0.0), []
    total = sum(run.length for run in runs)
    for run, size in zip(runs, sizes, strict=True):
        if (size if direction is None else size[:, direction]).max() < _STILL * largest:
            continue
        if direction is not None and _as_one(run, direction, used):
            found.append(_whole(run, direction, run.length / bars.span))
            continue

        def motion(values, run=run):
            u = bars.motion(*run.at(values[0]))
            return u if direction is None else u[direction : direction + 1]

        def site(values, run=run):
            here = run.site(values[0])
            return here if direction is None else replace(here, text=f"{here.text}, {DIRECTIONS[direction]}")

        starts = np.concatenate([[0.0], run.starts(2 * _EACH, run.length / total), [run.length]])
        if direction is None:  # what weighs more than the deck says may be what weighs there already
            starts = np.union1d(starts, _laden(model, run))
        where = Unknown(PLACE, "m", 0.0, run.length, log=False)
        dofs = (0, 1, 2) if direction is None else (direction,)
        found.append(Points((where,), starts[:, None], motion, site, run.length / bars.span, dofs))
    return found


def _laden(model: Reduced, run: Line) -> np.ndarray:
    """Places on a line at nodes with point masses, a few."""
    masses = [each.nodes.ravel() for each in model.problem.mesh.elements if each.type == "mass"]
    first, members = run.bars.before[run.members], run.bars.nodes[run.members]
    at = first[np.isin(members[:, 0], np.concatenate([*masses, np.zeros(0, int)]))]
    return at[:_EACH]


def _as_one(run: Line, direction: int, used: np.ndarray) -> bool:
    """Whether a line moves as one in a direction, as a bar does along itself: then no place on it is told from another."""
    rows = run.middles[:, direction] * used
    return bool(np.ptp(rows, axis=0).max() < _ALIKE * np.abs(rows).max())


def _whole(run: Line, direction: int, share: float) -> Points:
    """Anywhere along a line that moves as one in a direction."""
    ids = tuple(int(run.bars.ids[bar]) for bar in run.members)
    site = Site("element", ids, None, f"anywhere along {elements(ids)}, {DIRECTIONS[direction]}")
    row = run.middles[len(run.members) // 2, direction]
    return _place(row[None], site, share, (direction,))


def _nodes(model: Reduced) -> list[Points]:
    """Nodes that no bar touches."""
    mesh, bars, used, keep = model.problem.mesh, model.bars, _reach(model), wanted(model)
    touched = set() if bars is None else set(bars.nodes.ravel().tolist())
    free = [i for i in range(len(mesh.node_ids)) if i not in touched and (keep is None or keep[i])]
    rows = {i: model.node(i)[:3] for i in free}
    largest = max((np.abs(u * used).max() for u in rows.values()), default=0.0)
    found = []
    for i, u in rows.items():
        own = [d for d in range(3) if np.abs(u[d] * used).max() > _STILL * largest]
        if own:
            at = tuple(float(x) for x in mesh.coordinates[i])
            name = int(mesh.node_ids[i])
            site = Site("node", (name,), at, f"node {name}")
            found.append(_place(u[own], site, 1.0, tuple(own)))
    return found


def _split(node: Points) -> Iterator[Points]:
    rows, site = node.motion(np.zeros(0)), node.site(np.zeros(0))
    for row, d in zip(rows, node.dofs, strict=True):
        name = f"{site.ids[0]}{DIRECTIONS[d]}"
        here = Site("dof", (name,), site.position, name)
        yield _place(row[None], here, 1.0, (d,))


def _dofs(model: Reduced, together: bool) -> list[Points]:
    """Degrees of freedom of a model of matrices, rotations left out where they are known; or the nodes that they are of."""
    structure, keep = model.problem.structure, wanted(model)
    free = np.arange(structure.n) if keep is None else np.flatnonzero(keep)
    at = structure.geometry
    if at is not None:
        free = free[((at.direction < 3) & at.placed)[free]]
    if at is None or not together:
        sites = [named_dof(structure, int(i)) for i in free]
        return [_single(model, site, (int(i),)) for i, site in zip(free, sites, strict=True)]
    found = []
    for node in np.unique(at.node[free]):
        own = tuple(np.flatnonzero((at.node == node) & (at.direction < 3)).tolist())
        number = int(at.node_ids[node]) if node >= 0 else 0
        if node < 0:
            found += [_single(model, named_dof(structure, i), (i,)) for i in own]
        else:
            position = tuple(at.coordinates[node].tolist())
            found.append(_single(model, Site("node", (number,), position, f"node {number}"), own))
    return found


def named_dof(structure: Structure, i: int) -> Site:
    """A degree of freedom, and where it is if that is known."""
    at, label = structure.geometry, structure.labels[i]
    known = at is not None and at.node[i] >= 0
    here = tuple(at.coordinates[at.node[i]].tolist()) if known else None
    return Site("dof", (label,), here, f"degree of freedom {label}")


def _single(model: Reduced, site: Site, dofs: tuple[int, ...]) -> Points:
    return _place(model.V[list(dofs)], site, 1.0, dofs)


def _place(rows: np.ndarray, site: Site, share: float, dofs: tuple[int, ...]) -> Points:
    """A single place, which has no unknown."""
    return Points((), np.zeros((1, 0)), lambda values: rows, lambda values: site, share, dofs)
