"""Places at which one spring may end, and how they move: nodes of a mesh and what is between them, degrees of freedom."""

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from mouse_cli.diagnosis.extend.matrices import of_matrices
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.nameless._groups import places
from mouse_cli.diagnosis.nameless._motions import translations
from mouse_cli.diagnosis.sites.bars import Bars
from mouse_cli.diagnosis.sites.channels import coupled
from mouse_cli.diagnosis.sites.ends import joined
from mouse_cli.diagnosis.sites.pairs import pairs
from mouse_cli.diagnosis.sites.points import named_dof
from mouse_cli.model.diagnosis import Site
from mouse_cli.model.geometry import DIRECTIONS

_PLACES = 48  # that are looked at first, evenly among all
_NEAREST = 9  # degrees of freedom that are tried at the end of a spring
_STILL = 1e-6  # share of the largest motion below which a place does not move
_SHARES = np.linspace(0.0, 1.0, 5)  # of bars beside a node


@dataclass(frozen=True)
class Ends:
    """Places that move in one direction (0 to 5): sites, rows of motion (p, r), positions (p, d); numbers (p,): nodes or
    degrees of freedom, which a spring in a model of matrices is put at.
    """

    sites: tuple[Site, ...]
    rows: np.ndarray
    at: np.ndarray
    numbers: np.ndarray
    direction: int

    @property
    def turns(self) -> bool:
        """Whether their motion is a turn."""
        return self.direction > 2

    def some(self, kept: np.ndarray) -> "Ends":
        """The places `kept`, by index."""
        own = (self.rows[kept], self.at[kept], self.numbers[kept])
        return Ends(tuple(self.sites[i] for i in kept), *own, self.direction)


Spring = tuple[Ends, tuple[int, ...]]  # and which of its places: two, or one that turns


def springs(model: Reduced) -> Iterator[Spring]:
    """Between any two places that move in one direction and that nothing joins, and against any turn."""
    taken = _taken(model)
    for ends in _of_matrices(model) if of_matrices(model.problem) else _of_mesh(model):
        if ends.turns:
            yield from ((ends, (i,)) for i in range(len(ends.sites)))
            continue
        for i, a in enumerate(ends.numbers.tolist()):
            for j, b in enumerate(ends.numbers[:i].tolist()):
                if (b, a) not in taken:
                    yield ends, (i, j)


def _taken(model: Reduced) -> set[tuple[int, int]]:
    """Nodes or degrees of freedom (a < b) between which there is something, or may be something that has a name."""
    named = {tuple(sorted(key[:2])) for key in pairs(model).keys.tolist()}
    if not of_matrices(model.problem):
        return named | joined(model.problem.mesh)
    return named | set(zip(*(each.tolist() for each in coupled(model)), strict=True))


def _of_matrices(model: Reduced) -> Iterator[Ends]:
    known = model.problem.structure.geometry
    for d in [0] if known is None else sorted(set(known.direction.tolist())):
        every = _of_direction(model, d)
        yield every.some(_thinned(np.arange(len(every.sites))))


def _of_direction(model: Reduced, d: int) -> Ends:
    """Degrees of freedom of one direction that move."""
    structure = model.problem.structure
    own = translations(model)
    if structure.geometry is not None:
        along = np.flatnonzero((structure.geometry.direction == d) & structure.geometry.placed)
        own = along if d > 2 else np.intersect1d(own, along)
    sites = tuple(named_dof(structure, int(i)) for i in own)
    return _moving(Ends(sites, model.V[own], places(structure)[0][own], own, d))


def _of_mesh(model: Reduced) -> Iterator[Ends]:
    mesh = model.problem.mesh
    own = _thinned(np.unique(np.concatenate([each.nodes.ravel() for each in mesh.elements])))
    u = np.array([model.node(int(n)) for n in own])
    shift = np.abs(u[:, :3]).max(axis=(1, 2))
    u[shift <= _STILL * shift.max()] = 0.0  # at a support there are names for it
    for d in range(6):
        sites = tuple(_node(int(mesh.node_ids[n]), mesh.coordinates[n], d) for n in own)
        yield _moving(Ends(sites, u[:, d], mesh.coordinates[own], own, d))


def _node(number: int, at: np.ndarray, direction: int) -> Site:
    return Site("node", (number,), tuple(at.tolist()), f"node {number}{DIRECTIONS[direction]}")


def _thinned(every: np.ndarray) -> np.ndarray:
    return every[np.unique(np.linspace(0, len(every) - 1, _PLACES).round().astype(int))] if len(every) else every


def _moving(ends: Ends) -> Ends:
    size = np.abs(ends.rows).max(axis=1, initial=0.0)
    return ends.some(np.flatnonzero(size > _STILL * size.max(initial=0.0)))


def around(model: Reduced, ends: Ends, i: int) -> Ends:
    """Place i and those beside it that were not looked at: along bars, or of a model of matrices the nearest."""
    bars, node = model.bars, int(ends.numbers[i])
    itself = ends.some(np.array([i]))
    if of_matrices(model.problem):
        every = _of_direction(model, ends.direction)
        return every.some(np.argsort(np.linalg.norm(every.at - itself.at, axis=1), kind="stable")[:_NEAREST])
    if bars is None:
        return itself
    found = [itself]
    for bar in (twins[0] for twins in bars.twins.values() if node in bars.nodes[twins[0]]):
        for share in _SHARES[1:-1]:
            row = _motion(bars, bar, float(share))[ends.direction]
            site = bars.site(bar, float(share))
            site = replace(site, text=f"{site.text}, {DIRECTIONS[ends.direction]}")
            found.append(Ends((site,), row[None], np.array(site.position)[None], itself.numbers, ends.direction))
    sites = tuple(site for each in found for site in each.sites)
    rows, at, numbers = (np.concatenate([getattr(each, name) for each in found]) for name in ("rows", "at", "numbers"))
    return Ends(sites, rows, at, numbers, ends.direction)


def _motion(bars: Bars, bar: int, at: float) -> np.ndarray:
    """Displacement and turn (6, r) in global axes at a share of the length of a bar, but for its turn about itself."""
    l, turn = bars.length[bar], 0.0
    slope = np.array([6 * at * (at - 1) / l, (1 - at) * (1 - 3 * at), 6 * at * (1 - at) / l, at * (3 * at - 2)])
    for twin in bars.twins[int(bars.set[bar]), int(bars.member[bar])]:
        turn = turn + np.outer(np.cross(bars.axis[bar], bars.across[twin]), slope @ bars.ends[twin])
    return np.concatenate([bars.motion(bar, at), turn])
