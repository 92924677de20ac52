"""The `model: structure:` of a YAML deck: nodes, elements, supports, rigid links, and like beams that methods revise as a whole."""

import numpy as np

from mouse_cli.formats.draft import MeshDraft
from mouse_cli.formats.yaml_deck import values as yaml_values
from mouse_cli.formats.yaml_deck.ids import ids as read_ids
from mouse_cli.formats.yaml_deck.keys.structure import PLANES
from mouse_cli.formats.yaml_deck.kinds import KINDS
from mouse_cli.formats.yaml_deck.mesh_elements import Context, Elements, elements
from mouse_cli.formats.yaml_deck.mesh_nodes import Nodes, nodes, vector
from mouse_cli.formats.yaml_deck.mesh_options import directions
from mouse_cli.formats.yaml_deck.mesh_properties import cross_sections, materials
from mouse_cli.formats.yaml_deck.nodes import Node
from mouse_cli.formats.yaml_deck.sections import Section
from mouse_cli.model.geometry import DIRECTIONS
from mouse_cli.model.mesh import GenericGroup, Mesh, RigidLink

_ALL = tuple(range(len(DIRECTIONS)))


def structure(section: Section, labels: tuple[str, ...]) -> MeshDraft | None:
    """The mesh; None when nothing could be read of its elements.

    labels: the degrees of freedom of the matrices beside it; without nodes of its own, the structure stands on them.
    """
    document, where = section.document, section.document.span(section.node)
    on_matrices = "nodes" not in section
    found = _on_dofs(section, labels) if on_matrices else nodes(document, section.nodes["nodes"], section.what("nodes"))
    if "elements" not in section or found is None:
        return None
    context = Context(found.ids, labels if on_matrices else (), materials(section), cross_sections(section))
    made = elements(section, context)
    links = [link for each in section.listed("rigid_links") for link in _link(each, found.ids)]
    mesh = Mesh(
        found.ids,
        found.coordinates,
        tuple(made.sets),
        _supports(section, found.ids),
        tuple(links),
        (0,) if on_matrices else _directions(section),
        section.read("gravity", vector),
        generic(section, made),
    )
    return MeshDraft(
        mesh,
        where,
        found.where,
        lambda s, i: made.where[s](i),
        labels=labels if on_matrices else (),
    )


def _on_dofs(section: Section, labels: tuple[str, ...]) -> Nodes | None:
    """The degrees of freedom of a matrix model as nodes that move in one direction."""
    place = section.document.span(section.node)
    if not labels:
        message = (
            "model.structure has no nodes, and there are no matrices whose degrees of freedom could serve as nodes"
        )
        return section.document.error("MD211", section.node, message, "give nodes: {1: [x, y, z], ...}")
    return Nodes(np.arange(1, len(labels) + 1), np.zeros((len(labels), 3)), lambda _: place)


def _directions(section: Section) -> tuple[int, ...]:
    plane, given = section.value("plane"), section.nodes.get("directions")
    if plane is not None and given is not None:
        message = "model.structure gives plane and directions"
        section.document.error("MD217", given, message, "give one of the two")
    if given is not None:
        found = section.read("directions", directions)
        return tuple(sorted(set(found))) if found else _ALL
    return tuple(DIRECTIONS.index(name) for name in PLANES[plane]) if plane else _ALL


def _supports(section: Section, known: np.ndarray) -> np.ndarray:
    """(node index, direction) of each that is held, each once."""
    node, what = section.nodes.get("supports"), section.what("supports")
    if node is None:
        return np.zeros((0, 2), int)
    if not yaml_values.is_mapping(node):
        yaml_values.mistyped(section.document, node, what, KINDS["supports"].words)
        return np.zeros((0, 2), int)
    held: list[np.ndarray] = []
    for key, value in node.value:
        places = _places(section, key, what, known)
        every = yaml_values.is_scalar(value) and value.value == "all"
        along = _ALL if every else directions(section.document, value, f"{what}.{key.value}")
        if places is not None and along is not None:
            held.append(np.column_stack([np.repeat(places, len(along)), np.tile(along, len(places))]))
    return np.unique(np.concatenate(held), axis=0) if held else np.zeros((0, 2), int)


def _places(section: Section, node: Node, what: str, known: np.ndarray) -> np.ndarray | None:
    """Indices of the nodes that a text such as `1-5` or `all` names; MD401 for those that are not there."""
    numbers = read_ids(section.document, node, f"a node in {what}", known)
    if numbers is None:
        return None
    sorter = np.argsort(known, kind="stable")
    place = np.minimum(np.searchsorted(known, numbers, sorter=sorter), max(len(known) - 1, 0))
    absent = numbers if not len(known) else numbers[known[sorter[place]] != numbers]
    for number in absent[:20] if len(known) else ():
        message = f"{what} names node {number}, which is not among the nodes"
        section.document.error("MD401", node, message, "give the number of a node")
    return None if len(absent) else sorter[place]


def _link(section: Section, known: np.ndarray) -> list[RigidLink]:
    if "independent" not in section or "dependent" not in section:
        return []
    leads = _places(section, section.nodes["independent"], section.what("independent"), known)
    follow = _places(section, section.nodes["dependent"], section.what("dependent"), known)
    along = section.read("directions", directions) if "directions" in section else _ALL
    if leads is None or follow is None or along is None:
        return []
    if len(leads) != 1 or leads[0] in follow:
        message = f"{section.called} has node {section.nodes['independent'].value} follow itself"
        section.document.error("MD416", section.node, message, "name another node as the independent one")
        return []
    return [RigidLink(int(leads[0]), int(i), along) for i in follow]


COUPLINGS = ("k12", "k13", "k23")
_THEORIES = ("euler-bernoulli", "generic")


def generic(structure: Section, made: Elements) -> tuple[GenericGroup, ...]:
    """Every group; each element stands in one, and is a beam of a theory that has a generic form."""
    fit = {int(i): _fits(s) for s in made.sets for i in s.ids} if "generic" in structure else {}
    found, seen = [], {}
    for section in structure.listed("generic"):
        group = _group(section, fit)
        if group is not None:
            _once(section, group, seen)
            found.append(group)
    return tuple(found)


def _fits(members) -> bool:
    theory = members.options.get("theory") or _THEORIES[0]
    return members.type == "beam" and theory in _THEORIES


def _group(section: Section, fit: dict[int, bool]) -> GenericGroup | None:
    document, name, couplings = section.document, section.value("name"), section.value("couplings", ())
    if "elements" not in section or name is None or couplings is None:
        return None
    node = section.nodes["elements"]
    numbers = read_ids(document, node, section.what("elements"), np.array(list(fit), int))
    for word in (word for word in couplings if word not in COUPLINGS):
        message = f"{section.what('couplings')} names '{word[:20]}'; expected some of {', '.join(COUPLINGS)}"
        document.error("MD460", section.nodes["couplings"], message, "k12 couples bending, k13 and k23 torsion")
    if numbers is None:
        return None
    for number in numbers.tolist():
        if number not in fit and not document.incomplete:
            message = f"{section.what('elements')} names element {number}, which is not among the elements"
            document.error("MD403", node, message, "give numbers of elements")
        elif not fit.get(number, True):
            message = f"{section.what('elements')} names element {number}, which is no beam of Euler and Bernoulli"
            help = "give it theory: generic (antisymmetric 1/(1 + phi) for Timoshenko's), or leave it out"
            document.error("MD462", node, message, help)
    return GenericGroup(name, numbers, tuple(couplings))


def _once(section: Section, group: GenericGroup, seen: dict[int, str]) -> None:
    for number in group.elements.tolist():
        if number in seen:
            message = f"element {number} is in the generic groups '{seen[number]}' and '{group.name}'"
            section.document.error("MD461", section.nodes["elements"], message, "give it to one of them")
        seen[number] = group.name
