"""Where one force may act: along the lines of bars, at nodes, or at degrees of freedom of models without geometry."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np

from mouse_cli.diagnosis.change import Unknown
from mouse_cli.diagnosis.reduced import Reduced
from mouse_cli.model.diagnosis import Site
from mouse_cli.model.geometry import DIRECTIONS

_STILL = 0.02  # share of the largest motion in a measured mode below which a direction does not take part
_EACH = 6  # places to begin from on a line


@dataclass(frozen=True)
class Points:
    """Places of one kind, and how they move. length: share of all places, by which the prior is spread.

    motion(values): rows (d, r) of the displacement there, for the values of `unknown`, none of which for a single place.
    """

    unknown: tuple[Unknown, ...]
    starts: np.ndarray
    motion: Callable[[np.ndarray], np.ndarray]
    site: Callable[[np.ndarray], Site]
    share: float
    dofs: tuple[int, ...] = ()


def all_motions(model: Reduced) -> list[Points]:
    """Places with all their translations: where a mass may sit."""
    found = _lines(model, None) + _nodes(model) if model.motion is not None else _dofs(model)
    return _shared(found)


def directions(model: Reduced) -> list[Points]:
    """Places with one direction each: where a spring to the ground may act."""
    if model.motion is None:
        return _shared(_dofs(model))
    found = []
    for d in range(3):
        found += _lines(model, d)
    return _shared(found + [point for node in _nodes(model) for point in _split(node)])


def _shared(found: list[Points]) -> list[Points]:
    total = sum(point.share for point in found) or 1.0
    return [Points(p.unknown, p.starts, p.motion, p.site, p.share / total, p.dofs) for p in found]


def _reach(model: Reduced) -> np.ndarray:
    """Coordinates (r,) weighed by how much the measured modes hold of them: the lowest, evenly."""
    count = min(model.r, int(model.data.test.number.max()) + 2)
    return (np.arange(model.r) < count).astype(float)


def _lines(model: Reduced, direction: int | None) -> list[Points]:
    bars = model.bars
    if bars is None:
        return []
    used, seen = _reach(model), set()
    largest = max(np.abs(bars.motion(b, 0.5) * used).max() for b in range(len(bars)))
    found = []
    for line in bars.lines:
        key = tuple(sorted(zip(bars.set[line.members].tolist(), bars.member[line.members].tolist(), strict=True)))
        if key in seen:  # the same bars in their other plane
            continue
        seen.add(key)
        moves = max(
            np.abs((u if direction is None else u[direction]) * used).max()
            for b in line.members
            for u in (bars.motion(b, 0.5),)
        )
        if moves < _STILL * largest:
            continue
        where = Unknown("place", "m", 0.0, line.length, log=False)

        def motion(values, line=line):
            u = bars.motion(*line.at(values[0]))
            return u if direction is None else u[direction : direction + 1]

        def site(values, line=line):
            here = line.site(values[0])
            return (
                here
                if direction is None
                else Site(here.kind, here.ids, here.position, f"{here.text}, {DIRECTIONS[direction]}")
            )

        count = max(2, min(_EACH * 2, len(line.members)))
        starts = (np.arange(count) + 0.5) / count * line.length
        found.append(Points((where,), starts[:, None], motion, site, line.length / bars.span))
    return found


def _nodes(model: Reduced) -> list[Points]:
    """Nodes that no bar touches."""
    mesh, bars, used = model.problem.mesh, model.bars, _reach(model)
    touched = set() if bars is None else set(bars.nodes.ravel().tolist())
    rows = {i: model.node(i)[:3] for i in range(len(mesh.node_ids)) if i not in touched}
    largest = max((np.abs(u * used).max() for u in rows.values()), default=0.0)
    found = []
    for i, u in rows.items():
        own = [d for d in range(3) if np.abs(u[d] * used).max() > _STILL * largest]
        if own:
            at = tuple(float(x) for x in mesh.coordinates[i])
            name = int(mesh.node_ids[i])
            site = Site("node", (name,), at, f"node {name}")
            found.append(Points((), np.zeros((1, 0)), _fixed(u[own]), _fixed(site), 1.0, tuple(own)))
    return found


def _split(node: Points) -> Iterator[Points]:
    rows, site = node.motion(np.zeros(0)), node.site(np.zeros(0))
    for row, d in zip(rows, node.dofs, strict=True):
        name = f"{site.ids[0]}{DIRECTIONS[d]}"
        here = Site("dof", (name,), site.position, name)
        yield Points((), node.starts, _fixed(row[None]), _fixed(here), 1.0, (d,))


def _dofs(model: Reduced) -> list[Points]:
    """Degrees of freedom of a model without geometry."""
    labels = model.problem.structure.labels
    return [
        Points(
            (),
            np.zeros((1, 0)),
            _fixed(model.V[i : i + 1]),
            _fixed(Site("dof", (labels[i],), None, f"degree of freedom {labels[i]}")),
            1.0,
            (i,),
        )
        for i in range(len(labels))
    ]


def _fixed(value):
    return lambda values: value
