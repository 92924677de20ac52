"""Through what one force may act on a model, and where: a row B (r,) of the work it does in each coordinate.

force: along or across a bar, or in a direction of a node, or on a degree of freedom; moment: about an axis of a node. Pairs of
equal and opposite ones: hinge, the bending moments where a bar is softer; slide, the shear forces there; stretch, those along a
bar; pair, between two nodes or degrees of freedom that are coupled in K; tie, between two that nothing joins.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.sites.bars import Bars
from mouse_cli.diagnosis.sites.pairs import chosen, pairs, site_of
from mouse_cli.model.arrays import is_sparse
from mouse_cli.model.diagnosis import Site
from mouse_cli.model.geometry import DIRECTIONS
from mouse_cli.model.mesh import Mesh

FORCE, MOMENT, HINGE, SLIDE, STRETCH, PAIR, TIE = "force", "moment", "hinge", "slide", "stretch", "pair", "tie"
LIKELY = {
    FORCE: 1.0,
    HINGE: 1.0,
    PAIR: 1.0,
    MOMENT: 0.1,
    SLIDE: 0.1,
    STRETCH: 0.1,
    TIE: 0.1,
}  # masses turn, but they move first
_PLACES = 160  # places along bars from which on each bar has one
_STILL = 1e-9  # share of the largest motion below which a place does not move


@dataclass(frozen=True)
class Channel:
    """Places of one kind: B (j, r), `weight` (j,): share of the structure each stands for; site(i): where number i is."""

    name: str
    rows: np.ndarray
    weight: np.ndarray
    site: Callable[[int], Site]

    def __len__(self) -> int:
        return len(self.rows)


def channels(model: Reduced) -> list[Channel]:
    """All that one force may act through, those that the coordinates do not move left out."""
    found = _structure(model) if model.motion is not None else _of_matrices(model)
    found += _ties(model)
    return [moving for one in found if (moving := _moving(one)) is not None]


def _moving(one: Channel) -> Channel | None:
    """Without places that do not move; None when none is left."""
    size = np.sqrt(np.einsum("jr,jr->j", one.rows, one.rows))
    kept = np.flatnonzero(size > _STILL * size.max(initial=0.0))
    if not len(kept):
        return None
    if len(kept) == len(one):
        return one
    return Channel(one.name, one.rows[kept], one.weight[kept], lambda i: one.site(int(kept[i])))


def _structure(model: Reduced) -> list[Channel]:
    found = [] if model.bars is None else _along_bars(model.bars)
    return found + _at_nodes(model) + _between_nodes(model)


def _along_bars(bars: Bars) -> list[Channel]:
    """Places at even shares of every bar, both ends of a line among them; of a slide the place within a bar makes no difference."""
    each = max(1, min(8, _PLACES // len(bars)))
    bar = np.concatenate([np.repeat(np.arange(len(bars)), each), np.flatnonzero(bars.before == 0)])
    at = np.concatenate([np.tile(np.arange(1, each + 1) / each, len(bars)), np.zeros(len(bar) - each * len(bars))])
    l, weight = bars.length[bar], bars.length[bar] / each
    N = [1 - 3 * at**2 + 2 * at**3, l * at * (1 - at) ** 2, at**2 * (3 - 2 * at), l * at**2 * (at - 1)]
    slope = [6 * at * (at - 1) / l, (1 - at) * (1 - 3 * at), 6 * at * (1 - at) / l, at * (3 * at - 2)]
    yields = (bars.rigid() @ bars.strain)[:, :2]
    node = np.flatnonzero((at == 0) | (at == 1))
    once = np.flatnonzero(
        [bars.twins[int(s), int(e)][0] == i for i, (s, e) in enumerate(zip(bars.set, bars.member, strict=True))]
    )
    site = lambda i: bars.site(int(bar[i]), float(at[i]))
    middle = lambda i: bars.site(i, 0.5)
    force, moment = (np.einsum("cj,jcr->jr", np.array(shape), bars.ends[bar]) for shape in (N, slope))
    stretch = bars.axial[once, 1] - bars.axial[once, 0]
    return [
        Channel(FORCE, force, weight, site),
        Channel(FORCE, bars.axial[once, 1], bars.length[once], lambda i: bars.site(int(once[i]), 1.0)),
        Channel(MOMENT, moment[node], weight[node], lambda i: site(int(node[i]))),
        Channel(HINGE, yields[bar, 0] + (2 * at - 1)[:, None] * yields[bar, 1], weight, site),
        Channel(SLIDE, yields[:, 1], bars.length, middle),
        Channel(STRETCH, stretch, bars.length[once], lambda i: middle(int(once[i]))),
    ]


def _at_nodes(model: Reduced) -> list[Channel]:
    """Forces and moments on nodes that no bar touches."""
    mesh = model.problem.mesh
    u = model.motion.apply(model.V)[: 6 * len(mesh.node_ids)].reshape(-1, 6, model.r)
    nodes = np.arange(len(mesh.node_ids))
    if model.places is not None:
        nodes = np.unique(model.problem.structure.geometry.node[model.places])
    free = np.setdiff1d(nodes[nodes >= 0], [] if model.bars is None else model.bars.nodes)
    if not len(free):
        return []
    found = []
    for name, own in ((FORCE, range(3)), (MOMENT, range(3, 6))):
        places = [(int(i), d) for d in own for i in free]
        rows = np.concatenate([u[free, d] for d in own])
        found.append(Channel(name, rows, np.ones(len(rows)), lambda i, places=places: _node_site(mesh, *places[i])))
    return found


def _node_site(mesh: Mesh, node: int, direction: int) -> Site:
    name = f"{mesh.node_ids[node]}{DIRECTIONS[direction]}"
    return Site("dof", (name,), tuple(float(x) for x in mesh.coordinates[node]), name)


def _between_nodes(model: Reduced) -> list[Channel]:
    """Relative motions of nodes that two-node elements other than beams join, in every direction."""
    mesh, u, rows, places = model.problem.mesh, None, [], []
    for elements in mesh.elements:
        if elements.type == "beam" or elements.nodes.shape[1] != 2:
            continue
        u = model.motion.apply(model.V)[: 6 * len(mesh.node_ids)].reshape(-1, 6, model.r) if u is None else u
        one, other = elements.nodes.T
        for d in range(6):
            rows.append(u[other, d] - u[one, d])
            places += [(elements, i, d) for i in range(len(elements))]
    if not rows:
        return []

    def site(i: int) -> Site:
        elements, member, d = places[i]
        middle = tuple(float(x) for x in mesh.coordinates[elements.nodes[member]].mean(axis=0))
        return Site("element", (int(elements.ids[member]),), middle, f"element {elements.ids[member]}, {DIRECTIONS[d]}")

    joined = np.concatenate(rows)
    return [Channel(PAIR, joined, np.ones(len(joined)), site)]


def _ties(model: Reduced) -> list[Channel]:
    """Pairs that nothing joins."""
    found = chosen(model, pairs(model))
    if not len(found):
        return []
    return [Channel(TIE, found.rows, np.ones(len(found)), lambda i: site_of(model, found.keys[i]))]


def _of_matrices(model: Reduced) -> list[Channel]:
    """Degrees of freedom, and pairs of them that K couples."""
    structure = model.problem.structure
    at, labels = structure.geometry, structure.labels
    turns = np.zeros(structure.n, bool) if at is None else at.direction > 2
    dofs = np.arange(structure.n) if model.places is None else model.places
    dofs = dofs if at is None else dofs[at.placed[dofs]]

    def site(i: int) -> Site:
        where = None if at is None or at.node[i] < 0 else tuple(float(x) for x in at.coordinates[at.node[i]])
        return Site("dof", (labels[i],), where, f"degree of freedom {labels[i]}")

    found = []
    for name, own in ((FORCE, dofs[~turns[dofs]]), (MOMENT, dofs[turns[dofs]])):
        if len(own):
            found.append(Channel(name, model.V[own], np.ones(len(own)), lambda i, own=own: site(int(own[i]))))
    one, other = coupled(model)

    def between(i: int) -> Site:
        pair = (labels[one[i]], labels[other[i]])
        return Site("dof", pair, None, f"between degrees of freedom {pair[0]} and {pair[1]}")

    return [*found, Channel(PAIR, model.V[one] - model.V[other], np.ones(len(one)), between)] if len(one) else found


def coupled(model: Reduced) -> tuple[np.ndarray, np.ndarray]:
    """Degrees of freedom i < j (j,), (j,) with k_ij < 0, as a spring between them has; of one direction where it is known."""
    K, _ = model.assembly.matrices(model.theta)
    at = model.problem.structure.geometry
    if is_sparse(K):
        entries = K.tocoo()
        one, other, k = entries.row, entries.col, entries.data
    else:
        one, other = np.nonzero(K)
        k = K[one, other]
    kept = (one < other) & (k < 0)
    if model.places is not None:
        kept &= np.isin(one, model.places) & np.isin(other, model.places)
    if at is not None:
        kept &= (at.direction[one] == at.direction[other]) & (at.node[one] != at.node[other])
        kept &= at.placed[one] & at.placed[other]
    return one[kept], other[kept]
