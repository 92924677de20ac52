"""The `elements:` of a structure: which nodes they join, and what properties and options they have."""

from collections.abc import Callable
from dataclasses import dataclass, field
from difflib import get_close_matches
from typing import Any

import numpy as np

from mouse_cli._span import Span
from mouse_cli.formats.yaml_deck import values as yaml_values
from mouse_cli.formats.yaml_deck.dofs import dofs
from mouse_cli.formats.yaml_deck.files import read_below
from mouse_cli.formats.yaml_deck.ids import ids as read_ids
from mouse_cli.formats.yaml_deck.keys.structure import ELEMENT
from mouse_cli.formats.yaml_deck.kinds import KINDS, MAX_WHOLE
from mouse_cli.formats.yaml_deck.mesh_options import option
from mouse_cli.formats.yaml_deck.mesh_properties import Named
from mouse_cli.formats.yaml_deck.nodes import Document, Node
from mouse_cli.formats.yaml_deck.schema import SECTIONS
from mouse_cli.formats.yaml_deck.sections import Section
from mouse_cli.formats.yaml_deck.tables import read_table
from mouse_cli.model.mesh import ElementSet
from mouse_cli.terms.elements import ElementType, registry


@dataclass
class Elements:
    """Element sets in the order of the deck, and the place of element `i` of set `s`."""

    sets: list[ElementSet] = field(default_factory=list)
    where: list[Callable[[int], Span]] = field(default_factory=list)


@dataclass
class Joined:
    """Which nodes the elements of one entry join: numbers of nodes (e, k), of elements (e,), and properties from a table."""

    nodes: np.ndarray
    ids: np.ndarray | None = None
    properties: dict[str, np.ndarray] = field(default_factory=dict)


@dataclass
class Context:
    """What the entries refer to: numbers of nodes (k,), labels of degrees of freedom that serve as nodes, materials, sections."""

    node_ids: np.ndarray
    labels: tuple[str, ...]
    materials: Named
    sections: Named


def elements(structure: Section, context: Context) -> Elements:
    """Every entry of `elements:`; each number stands once."""
    found, document = Elements(), structure.document
    what = structure.what("elements")
    nodes = yaml_values.items(document, structure.nodes["elements"], what, "a list, one item for each element or group")
    highest, seen = 0, np.zeros(0, int)
    for i, node in enumerate(nodes or [], 1):
        section = _section(document, node, f"{what}[{i}]")
        made = None if section is None else _set(section, context, highest)
        if made is None:
            continue
        again = np.intersect1d(made.ids, seen) if len(made) > 1 else seen[seen == made.ids[0]]
        for number in again[:20]:
            document.error(
                "MD404", section.node, f"element {number} is given twice", "give each element its own number"
            )
        seen, highest = np.append(seen, made.ids), max(highest, int(made.ids.max()))
        found.sets.append(made)
        found.where.append(_where(section, len(made)))
    return found


def _section(document: Document, node: Node, what: str) -> Section | None:
    """The entry, by the keys of its type; None when it has none."""
    known = SECTIONS["element"].variants
    given = [v for k, v in node.value if k.value == "type"] if yaml_values.is_mapping(node) else []
    name = ELEMENT + str(given[0].value) if given else known[0]
    if name in known:
        return Section(document, node, name, what)
    types = [variant.removeprefix(ELEMENT) for variant in known]
    near = get_close_matches(str(given[0].value), types, 1)
    message = f"{what}.type is {yaml_values.shown(given[0])}; expected one of {', '.join(types)}"
    return document.error("MD214", given[0], message, f"write {near[0]}" if near else f"give one of {', '.join(types)}")


def _where(section: Section, count: int) -> Callable[[int], Span]:
    """Place of element `i`: its number or its nodes in the list, where there are such lists."""
    for key in ("nodes", "id"):
        node = section.nodes.get(key)
        if node is not None and yaml_values.is_list(node) and len(node.value) == count > 1:
            return section.document.where(node.value)
    place = section.document.span(section.node)
    return lambda _: place


def _set(section: Section, context: Context, highest: int) -> ElementSet | None:
    """One entry; None after an error."""
    kind = registry().get(section.value("type"))
    if kind is None:
        return None
    before, section.document.incomplete = section.document.incomplete, False
    joined = _joined(section, kind, context)
    if joined is not None:
        index = _indices(section, joined.nodes, context.node_ids)
        numbers = _numbers(section, joined, highest)
        properties, origin = _properties(section, kind, joined, context)
        options = {key: option(section, key, kind.options[key]) for key in section.nodes if key in kind.options}
    sound = not section.document.incomplete and joined is not None
    section.document.incomplete |= before
    return ElementSet(kind.key, numbers, index, properties, options, origin) if sound else None


def _joined(section: Section, kind: ElementType, context: Context) -> Joined | None:
    given = [key for key in ("nodes", "dofs", "file") if key in section]
    if len(given) != 1:
        message = f"{section.called} gives {' and '.join(given) or 'neither nodes nor file'}"
        return section.document.error("MD217", section.node, message, "give nodes, or file: a table of id and nodes")
    node = section.nodes[given[0]]
    return {"nodes": _nodes, "dofs": _dofs, "file": _file}[given[0]](section, node, kind, context)


def _nodes(section: Section, node: Node, kind: ElementType, context: Context) -> Joined | None:
    """A chain, one element at each node, or the nodes of each element."""
    document, what = section.document, section.what("nodes")
    if yaml_values.is_list(node) and node.value and all(yaml_values.is_list(item) for item in node.value):
        return _each(section, node, kind)
    chain = read_ids(document, node, what, context.node_ids)
    given = "id" in section
    numbers = section.read("id", read_ids)
    if chain is None or (given and numbers is None):
        return None
    count = len(numbers) if given else None
    apart = 1 in kind.nodes and (2 not in kind.nodes or len(chain) == 1 or count == len(chain))
    if apart:
        return Joined(chain[:, None])
    if 2 in kind.nodes and len(chain) > 1:
        return Joined(np.column_stack([chain[:-1], chain[1:]]))
    if len(chain) in kind.nodes:
        return Joined(chain[None, :])
    return _misfit(section, node, kind, f"{len(chain)} node{'s' * (len(chain) != 1)}")


def _each(section: Section, node: Node, kind: ElementType) -> Joined | None:
    width = len(node.value[0].value)
    wrong = next((item for item in node.value if len(item.value) != width or width not in kind.nodes), None)
    if wrong is not None:
        return _misfit(section, wrong, kind, f"{len(wrong.value)} nodes")
    flat = [item for row in node.value for item in row.value]
    found = yaml_values.indices(section.document, flat, section.what("nodes"))
    return None if found is None else Joined(found.reshape(-1, width))


def _misfit(section: Section, node: Node, kind: ElementType, given: str) -> None:
    possible = " or ".join(map(str, kind.nodes))
    message = f"{section.called} joins {given}; a {kind.key} has {possible}"
    section.document.error("MD407", node, message, f"give {possible} node{'s' * (possible != '1')} for each element")


def _dofs(section: Section, node: Node, kind: ElementType, context: Context) -> Joined | None:
    """Degrees of freedom of a matrix model, each of which is a node that moves in one direction."""
    if not context.labels:
        message = f"{section.what('dofs')} are for matrix models; this structure has nodes"
        return section.document.error("MD407", node, message, "give nodes")
    found = dofs(section.document, node, section.what("dofs"), context.labels)
    if found is None:
        return None
    if len(found) in kind.nodes:
        return Joined(found[None, :])
    return _misfit(section, node, kind, f"{len(found)} degrees of freedom")


def _file(section: Section, node: Node, kind: ElementType, context: Context) -> Joined | None:
    """A table: id, nodes, and further columns that its head names as properties."""
    least = 1 + min(kind.nodes)
    table = read_below(section.document, node, section.what("file"), read_table, least=least)
    if table is None:
        return None
    width = table.values.shape[1]
    named = [name in kind.properties for name in table.head] or [False] * width
    k = named.index(True) - 1 if True in named else width - 1
    if k not in kind.nodes or not all(named[1 + k :]):
        unknown = [name for name, known in zip(table.head[1 + k :], named[1 + k :], strict=False) if not known]
        more = f", and {', '.join(unknown)} is no property of it" if unknown else ""
        return _misfit(section, node, kind, f"{k} nodes in each line of its file{more}")
    whole = table.values[:, : 1 + k]
    if not ((whole == np.floor(whole)) & (np.abs(whole) <= MAX_WHOLE)).all():
        return section.document.error(
            "MD419", node, "the table has numbers that are not whole", "give id and nodes first"
        )
    properties = dict(zip(table.head[1 + k :], table.values[:, 1 + k :].T, strict=True))
    return Joined(whole[:, 1:].astype(int), whole[:, 0].astype(int), properties)


def _numbers(section: Section, joined: Joined, highest: int) -> np.ndarray | None:
    """Numbers of the elements: from the table, as given, or on from the highest so far."""
    document, count = section.document, len(joined.nodes)
    if "id" not in section:
        return highest + 1 + np.arange(count) if joined.ids is None else joined.ids
    node = section.nodes["id"]
    if joined.ids is not None:
        return document.error("MD217", node, f"{section.called} gives id and file", "the file holds the numbers")
    found = section.read("id", read_ids)
    if found is None or len(found) == count:
        return found
    message = f"{section.what('id')} has {len(found)} numbers, but the nodes make {count} elements"
    return document.error("MD407", node, message, "a chain has one node more than elements")


def _indices(section: Section, numbers: np.ndarray, known: np.ndarray) -> np.ndarray | None:
    """Places in `known` of the nodes `numbers`; MD401 for each that is not there."""
    if not len(known):
        return None if section.document.incomplete else np.zeros_like(numbers)
    sorter = np.argsort(known, kind="stable")
    place = np.minimum(np.searchsorted(known, numbers, sorter=sorter), len(known) - 1)
    absent = np.unique(numbers[known[sorter[place]] != numbers])
    node = section.nodes.get("nodes") or section.nodes.get("file") or section.node
    if len(absent) and any(each.code == "MD404" for each in section.document.diagnostics):
        section.document.incomplete = True  # nodes with wrong numbers: others are missing for it
        return None
    for number in absent[:20]:
        near = known[np.argsort(np.abs(known - number), kind="stable")[:3]]
        message = f"{section.called} joins node {number}, which is not among the nodes"
        section.document.error("MD401", node, message, f"give one of the nodes, such as {', '.join(map(str, near))}")
    return sorter[place]


def _properties(
    section: Section, kind: ElementType, joined: Joined, context: Context
) -> tuple[dict[str, np.ndarray], dict[str, str]]:
    """Values (e,) of each property that is given, and the material or section that some came from."""
    values: dict[str, np.ndarray] = {}
    origin: dict[str, str] = {}
    e = len(joined.nodes)
    for key, table, code in (("material", context.materials, "materials"), ("section", context.sections, "sections")):
        name = section.value(key)
        if name is None:
            continue
        if name not in table:
            _unknown_name(section, key, name, table, code)
        own = {p: v for p, v in table.get(name, {}).items() if p in kind.properties}
        if name not in table or None in own.values():  # an error by now: what the elements lack follows from it
            section.document.incomplete = True
            return {}, {}
        values |= {p: np.full(e, v) for p, v in own.items()}
        origin |= dict.fromkeys(own, name)
    direct = {**joined.properties, **_direct(section, kind, e)}
    values |= direct
    _required(section, kind, values)
    return values, {p: name for p, name in origin.items() if p not in direct}


def _unknown_name(section: Section, key: str, name: str, table: Named, plural: str) -> None:
    near = get_close_matches(name, table, 1)
    help = f"write '{near[0]}'" if near else f"the {plural} are {', '.join(table) or 'none'}"
    message = f"{section.called} is of {key} '{name[:40]}', which is not among {plural}"
    section.document.error("MD402", section.nodes[key], message, help)


def _direct(section: Section, kind: ElementType, e: int) -> dict[str, np.ndarray]:
    """The properties that stand in the entry itself, or in its mapping `stiffness`."""
    below = section.section("stiffness") if "stiffness" in section else None
    given = {(section, key): node for key, node in section.nodes.items()}
    given |= {(below, key): node for key, node in below.nodes.items()} if below else {}
    found = {
        key: _value(section.document, node, owner.what(key), e)
        for (owner, key), node in given.items()
        if key in kind.properties
    }
    return {key: value for key, value in found.items() if value is not None}


def _value(document: Document, node: Node, what: str, e: int) -> np.ndarray | None:
    """A number for all, or one for each of the e elements."""
    if not yaml_values.is_list(node):
        one = yaml_values.number(document, node, what, KINDS["value or values"].words)
        return None if one is None else np.full(e, one)
    found = yaml_values.numbers(document, node, what)
    if found is None or len(found) == e:
        return found
    return document.error("MD216", node, f"{what} has {len(found)} numbers for {e} elements", f"give 1 or {e} numbers")


def _required(section: Section, kind: ElementType, values: dict[str, Any]) -> None:
    words = {str(node.value) for key, node in section.nodes.items() if key in kind.options}
    for name, about in kind.properties.items():
        if about.default is None and name not in values and (not about.only or words & set(about.only)):
            message = f"{section.called} has no {name}, the {about.meaning} of a {kind.key} in {about.unit}"
            section.document.error("MD405", section.node, message, f"give {name}, or a material or section that has it")
