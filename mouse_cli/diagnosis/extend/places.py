"""Where a place of a diagnosis is in a deck, also in one that was changed since: by coordinates, and by numbers that stay."""

import re
from collections.abc import Iterable

import numpy as np

from mouse_cli.diagnosis.extend.edit import Edit
from mouse_cli.model.diagnosis import Site
from mouse_cli.model.geometry import DIRECTIONS
from mouse_cli.model.mesh import RigidLink

_CLOSE = 1e-6  # of the size of the structure
_STIFF = 1e4  # times the stiffness of the bar, where a direction must be kept rigid that no global axis is along
_ALIGNED = 1 - 1e-9


def element_at(edit: Edit, point: np.ndarray, axis: np.ndarray | None = None) -> tuple[tuple[int, int], float]:
    """The beam through `point`, the most parallel to `axis` (3,) where several meet, and the share of its length there."""
    best, found = (np.inf, 0.0), None
    xyz = np.array(edit.coordinates)
    size = _CLOSE * np.ptp(xyz, axis=0).max()
    for s, members in enumerate(edit.sets):
        if members.type != "beam":
            continue
        start, along = xyz[members.nodes[:, 0]], np.diff(xyz[members.nodes], axis=1)[:, 0]
        length = np.linalg.norm(along, axis=1)
        share = np.clip(np.einsum("ei,ei->e", point - start, along) / length**2, 0.0, 1.0)
        off = np.linalg.norm(start + share[:, None] * along - point, axis=1)
        turned = np.zeros(len(off)) if axis is None else 1 - np.abs(along @ axis) / length
        i = int(np.lexsort((turned, np.maximum(off, size)))[0])
        key = (max(float(off[i]), size), float(turned[i]))
        if key < best:
            best, found = key, ((s, i), float(share[i]))
    return found


def node_at(edit: Edit, site: Site) -> int:
    """The node (index) of a place: one that is there, or a new one in the element that it is within."""
    if site.kind in ("node", "dof"):
        return edit.index(int(re.match(r"\d+", str(site.ids[0]))[0]))
    if site.position is None:  # anywhere along these elements
        s, i = edit.element(int(site.ids[len(site.ids) // 2]))
        return int(edit.sets[s].nodes[i, 0])
    element, share = element_at(edit, np.array(site.position))
    return edit.split(element, share)


def beams_within(edit: Edit, segments: Iterable[tuple[np.ndarray, np.ndarray]]) -> list[tuple[int, int]]:
    """Beams whose middle lies on one of the `segments` (start, end)."""
    xyz, found = np.array(edit.coordinates), []
    size = _CLOSE * np.ptp(xyz, axis=0).max()
    starts, ends = (np.array(part) for part in zip(*segments, strict=True))
    along = ends - starts
    for s, members in enumerate(edit.sets):
        if members.type != "beam":
            continue
        middle = xyz[members.nodes].mean(axis=1)
        share = np.einsum("esi,si->es", middle[:, None] - starts, along) / (along**2).sum(axis=1)
        foot = starts + np.clip(share, 0, 1)[..., None] * along
        near = np.linalg.norm(middle[:, None] - foot, axis=2).min(axis=1) <= size
        found += [(s, int(i)) for i in np.flatnonzero(near)]
    return found


def every_beam(edit: Edit) -> list[tuple[int, int]]:
    """All beams of the deck."""
    return [(s, i) for s, members in enumerate(edit.sets) if members.type == "beam" for i in range(len(members))]


def every_cable(edit: Edit) -> list[tuple[int, int]]:
    """All rods under tension that another one continues: strings and cables in pieces, which move across themselves."""
    taut = {
        (s, i)
        for s, members in enumerate(edit.sets)
        if members.type == "rod"
        for i in np.flatnonzero(np.broadcast_to(members.properties.get("preload", 0.0), len(members)) > 0).tolist()
    }
    meeting: dict[int, list[tuple[int, int]]] = {}
    for s, members in enumerate(edit.sets if taut else []):
        for i, nodes in enumerate(members.nodes.tolist()):
            for node in nodes if members.type != "mass" else ():
                meeting.setdefault(node, []).append((s, i))
    pairs = [own for own in meeting.values() if len(own) == 2 and taut.issuperset(own)]
    return sorted({each for own in pairs for each in own})


def split(edit: Edit, ends: tuple[np.ndarray, np.ndarray]) -> None:
    """Splits the beams in which a segment begins and ends."""
    for end in ends:
        edit.split(*element_at(edit, end, ends[1] - ends[0]))


def hinge(
    edit: Edit,
    element: tuple[int, int],
    end: int,
    axes: np.ndarray,
    turning: float,
    sliding: float = 0.0,
    parting: float = 0.0,
    off: float = 0.0,
    other: float = 0.0,
    twisting: float = 0.0,
) -> tuple[tuple[int, int], dict[str, float]]:
    """A spring (N m/rad) in place of the rigid connection of one end of a beam: the element that it is, what is soft by key.

    axes (3, 3), rows: along the bar, the direction in which it bends, and the axis about which it does. sliding: stiffness (N/m)
    across the bar there, parting: along it, other: (N m/rad) in the other plane, twisting: about the bar; 0: rigid. off: how far
    from the axis it turns.
    """
    old = int(edit.sets[element[0]].nodes[element[1], end])
    new = edit.detach(element, end)
    turn, across, along = (_global(axes[k]) for k in (2, 1, 0))
    if turn is not None and (across is not None or not (sliding or other or twisting)) and not parting:
        soft = {3 + turn: turning} | ({across: sliding} if sliding else {}) | ({3 + across: other} if other else {})
        soft |= {3 + along: twisting} if twisting else {}
        edit.links.append(RigidLink(old, new, tuple(d for d in range(6) if d not in soft)))
        values = {DIRECTIONS[d]: value for d, value in soft.items()}
        return edit.add("spring", [[old, new]], values)[0], values
    values = {"RZ": turning, "TY": sliding, "TX": parting, "RY": other, "RX": twisting}
    values = {key: value for key, value in values.items() if value}
    return _joint(edit, element, (old, new), axes, values, off), values


def _joint(
    edit: Edit, element, nodes: tuple[int, int], axes: np.ndarray, soft: dict[str, float], off: float
) -> tuple[int, int]:
    """The same across any axes, `off` from the bar: what must be rigid is _STIFF times as stiff as the bar."""
    xyz = np.array(edit.coordinates)
    s, i = element
    length = float(np.linalg.norm(np.diff(xyz[edit.sets[s].nodes[i]], axis=0)))
    E, G, A, J = (edit.values(element, name) for name in ("E", "G", "A", "J"))
    EI = E * max(edit.values(element, "Iy"), edit.values(element, "Iz"))
    across, along, turn = 12 * EI / length**3, E * A / length, max(4 * EI, G * J) / length
    values = dict(zip(DIRECTIONS, _STIFF * np.array([along, across, across, turn, turn, turn]), strict=True))
    values |= soft
    options: dict = {"axes": [axes[0].tolist(), axes[1].tolist()]}
    if off:
        options["at"] = (xyz[nodes[0]] + off * axes[1]).tolist()
    return edit.add("joint", [list(nodes)], values, options)[0]


def _global(vector: np.ndarray) -> int | None:
    """The global axis that a unit vector is along, if any."""
    d = int(np.argmax(np.abs(vector)))
    return d if abs(vector[d]) > _ALIGNED else None
