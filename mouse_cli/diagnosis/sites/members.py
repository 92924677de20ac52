"""Members of a structure as its engineer sees them: alone, in a row through joints, those of a storey, all of one section."""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from mouse_cli.diagnosis.sites.lines import STRAIGHT, elements
from mouse_cli.model.diagnosis import Site
from mouse_cli.model.mesh import ElementSet, Mesh

SLENDER = ("beam", "rod")
_SECTION = ("A", "Iy", "Iz", "J", "E")
_GROUPED = (*SLENDER, "storey")

Element = tuple[int, int]  # set and member


@dataclass(frozen=True)
class Member:
    """Elements (set, member) that are one part; kind: ONE, ROW, STOREY or ALIKE; text: in words."""

    kind: str
    elements: tuple[Element, ...]
    site: Site


ONE, ROW, STOREY, ALIKE = "one", "row", "storey", "alike"
COLUMNS, BRACES, BEAMS = "columns", "braces", "beams"
_UPRIGHT, _FLAT = 0.9, 0.1  # height of a column over its length, at least, and of a beam, at most
_LEVEL = 1e-3  # of the height of the structure, within which levels are one


def members(mesh: Mesh) -> list[Member]:
    """All members, rows of them, those of a storey and groups of one section, each once; the structure as a whole is none."""
    sets = [s for s, each in enumerate(mesh.elements) if each.type in _GROUPED]
    slender = [(s, i) for s in sets if mesh.elements[s].type in SLENDER for i in range(len(mesh.elements[s]))]
    ones, rows = _chains(mesh, slender)
    total, found = sum(len(mesh.elements[s]) for s in sets), {}
    for kind, parts in ((ONE, ones), (ROW, rows), (STOREY, _storeys(mesh, ones)), (ALIKE, _alike(mesh, sets))):
        for part in parts:
            single = len(part) == 1 and mesh.elements[part[0][0]].type != "beam"  # which losses of elements know
            if len(part) < total and not single:
                found.setdefault(tuple(sorted(part)), Member(kind, tuple(part), described(mesh, part, kind)))
    return list(found.values())


def among(mesh: Mesh, own: set[Element], text: str) -> list[Member]:
    """Members all of whose elements are `own`, and all of these, called `text`, where they are none."""
    found = [member for member in members(mesh) if own.issuperset(member.elements)]
    if own and all(set(member.elements) != own for member in found):
        every = tuple(sorted(own))
        ids = tuple(int(mesh.elements[s].ids[i]) for s, i in every)
        found.append(Member(ALIKE, every, Site("element", ids, None, text)))
    return found


def rods(mesh: Mesh) -> list[Member]:
    """Those with a mass, which are no `members` alone, for losses of elements know them and leave that mass where it is."""
    return [
        Member(ONE, ((s, i),), described(mesh, [(s, i)], ONE))
        for s, own in enumerate(mesh.elements)
        for i in (np.flatnonzero(own.properties.get("density", 0.0)).tolist() if own.type == "rod" else ())
    ]


def crossed(mesh: Mesh) -> set[int]:
    """Nodes (indices) where more than two beams or rods meet: joints, which a row may pass and a member does not."""
    count = np.zeros(len(mesh.node_ids), int)
    for own in mesh.elements:
        if own.type in SLENDER:
            np.add.at(count, own.nodes.ravel(), 1)
    return set(np.flatnonzero(count > 2).tolist())


def _chains(mesh: Mesh, slender: list[Element]) -> tuple[list[list[Element]], list[list[Element]]]:
    """Members, which end where others begin or the section changes; and rows of them that go straight on."""
    at: dict[int, list[int]] = {}
    for n, (s, i) in enumerate(slender):
        for node in mesh.elements[s].nodes[i].tolist():
            at.setdefault(node, []).append(n)
    along = [_direction(mesh, each) for each in slender]
    on, through = [], []
    for node, meeting in at.items():
        out = {
            n: along[n] if mesh.elements[slender[n][0]].nodes[slender[n][1], 0] == node else -along[n] for n in meeting
        }
        for k, n in enumerate(meeting):
            for other in meeting[k + 1 :]:
                if out[n] @ out[other] < -STRAIGHT and _type(mesh, slender[n]) == _type(mesh, slender[other]):
                    through.append((n, other))
                    if len(meeting) == 2 and _same(mesh, slender[n], slender[other]):
                        on.append((n, other))
    return tuple([[slender[n] for n in part] for part in _joined(len(slender), pairs)] for pairs in (on, through))


def _type(mesh: Mesh, element: Element) -> str:
    return mesh.elements[element[0]].type


def _direction(mesh: Mesh, element: Element) -> np.ndarray:
    """Unit vector (3,) from the first to the second node."""
    s, i = element
    a, b = mesh.coordinates[mesh.elements[s].nodes[i]]
    return (b - a) / max(float(np.linalg.norm(b - a)), 1e-300)


def _same(mesh: Mesh, one: Element, other: Element) -> bool:
    """Whether two elements have the same section and material."""
    return _section(mesh.elements[one[0]], one[1]) == _section(mesh.elements[other[0]], other[1])


def _section(own: ElementSet, i: int) -> tuple:
    return tuple(float(own.properties[name][i]) for name in _SECTION if name in own.properties)


def _joined(count: int, pairs: Iterable[tuple[int, int]]) -> list[list[int]]:
    """Numbers up to `count` in parts that `pairs` connect, in the order of their first."""
    first = list(range(count))

    def root(n: int) -> int:
        while first[n] != n:
            first[n] = first[first[n]]
            n = first[n]
        return n

    for a, b in pairs:
        a, b = sorted((root(a), root(b)))
        first[b] = a
    parts: dict[int, list[int]] = {}
    for n in range(count):
        parts.setdefault(root(n), []).append(n)
    return list(parts.values())


def _alike(mesh: Mesh, sets: list[int]) -> Iterator[list[Element]]:
    """All elements of one section, by its name or its values, and all of one entry of the deck."""
    found: dict[tuple, list[Element]] = {}
    for s in sets:
        own = mesh.elements[s]
        name = own.origin.get("A") or own.origin.get("E")
        for i in range(len(own)):
            key = (own.type, name) if name else (own.type, *_section(own, i)) if own.type in SLENDER else (own.type, s)
            found.setdefault(key, []).append((s, i))
    yield from (part for part in found.values() if len(part) > 1)


def _storeys(mesh: Mesh, ones: list[list[Element]]) -> Iterator[list[Element]]:
    """Columns between the same two levels; braces between them, and beams at one level, of one section: where there are several."""
    up = upward(mesh)
    height = float(np.ptp(mesh.coordinates[:, up])) or 1.0
    found: dict[tuple, list[list[Element]]] = {}
    for part in ones:
        ends, kind = _box(mesh, part), _inclined(mesh, part)
        levels = np.rint(ends[:, up] / (_LEVEL * height)).astype(int).tolist()
        section = () if kind == COLUMNS else (_type(mesh, part[0]), _section(mesh.elements[part[0][0]], part[0][1]))
        found.setdefault((kind, *levels, *section), []).append(part)
    yield from ([element for part in parts for element in part] for parts in found.values() if len(parts) > 1)


def _inclined(mesh: Mesh, part: Sequence[Element]) -> str:
    """Whether a member is one of COLUMNS, BRACES or BEAMS, by how it rises from its lower to its upper end."""
    ends = np.ptp(_box(mesh, part), axis=0)
    steep = ends[upward(mesh)] / max(float(np.linalg.norm(ends)), 1e-300)
    return COLUMNS if steep > _UPRIGHT else BRACES if steep > _FLAT else BEAMS


def upward(mesh: Mesh) -> int:
    """The axis that points up: Z where the structure has height along it, else Y."""
    return 2 if np.ptp(mesh.coordinates[:, 2]) > 0 else 1


def _box(mesh: Mesh, part: Sequence[Element]) -> np.ndarray:
    """Least and largest coordinates (2, 3) of a part."""
    nodes = np.unique(np.concatenate([mesh.elements[s].nodes[i] for s, i in part]))
    return np.array([mesh.coordinates[nodes].min(axis=0), mesh.coordinates[nodes].max(axis=0)])


def described(mesh: Mesh, part: Sequence[Element], kind: str) -> Site:
    """The site of a part: in words; where it is, unless it is all over the structure."""
    ids = tuple(int(mesh.elements[s].ids[i]) for s, i in part)
    box, own = _box(mesh, part), mesh.elements[part[0][0]]
    middle = box.mean(axis=0)
    if kind == ALIKE:
        name = own.origin.get("A") or own.origin.get("E")
        text = f"all of {name}" if name else f"all of {elements(ids)}"
        return Site("element", ids, None, f"{text}, alike")
    if kind == STOREY:
        up = upward(mesh)
        levels = list(dict.fromkeys(f"{level:.4g}" for level in box[:, up].tolist()))
        at = f"{'between' if len(levels) > 1 else 'at'} {'XYZ'[up]} = {' and '.join(levels)}"
        return Site("element", ids, tuple(middle.tolist()), f"the {_inclined(mesh, part[:1])} {at}")
    text = elements(ids) if kind == ONE else f"the row of {elements(ids)}"
    return Site("element", ids, tuple(middle.tolist()), text)
