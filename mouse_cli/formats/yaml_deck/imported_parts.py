"""`model.supports` and `model.sets` of a YAML deck: what holds imported matrices, and what they are made of."""

import numpy as np

from mouse_cli.formats import matrix_files
from mouse_cli.formats.draft import SupportDraft
from mouse_cli.formats.yaml_deck.dofs import dofs as read_dofs
from mouse_cli.formats.yaml_deck.files import named, read_kept
from mouse_cli.formats.yaml_deck.ids import ids
from mouse_cli.formats.yaml_deck.imported import Rows
from mouse_cli.formats.yaml_deck.mesh_options import directions
from mouse_cli.formats.yaml_deck.sections import Section
from mouse_cli.model.geometry import DIRECTIONS
from mouse_cli.model.held import ElementGroup


def supports(section: Section, labels: tuple[str, ...]) -> tuple[SupportDraft, ...]:
    """The supports by name; those of a structure stand below it."""
    given = section.named("supports")
    if given and "structure" in section:
        message = "model.supports holds imported matrices; a structure has supports of its own"
        section.document.error("MD276", section.nodes["supports"], message, "write them below model.structure")
        return ()
    found = []
    for name, below in given.items():
        form = below.form()
        held = (
            None if form is None else below.read("dofs", read_dofs, labels) if form == "dofs" else _nodes(below, labels)
        )
        if held is not None:
            found.append(SupportDraft(name, held, section.document.span(below.node)))
    return tuple(found)


def _nodes(section: Section, labels: tuple[str, ...]) -> np.ndarray | None:
    numbers, held = section.read("nodes", ids), section.read("directions", directions)
    if numbers is None or held is None:
        return None
    place = {label: i for i, label in enumerate(labels, 1)}
    names = [f"{node}{DIRECTIONS[d]}" for node in numbers.tolist() for d in held]
    absent = [name for name in names if name not in place]
    if absent:
        message = f"{section.called} holds {absent[0]}, which is no degree of freedom of the model ({len(absent)} such)"
        help = "give nodes and directions that the matrices have, by model.dofs"
        return section.document.error("MD276", section.nodes["nodes"], message, help)
    return np.array([place[name] for name in names])


def element_sets(section: Section, order: int, rows: Rows) -> tuple[ElementGroup, ...]:
    """The element sets by name."""
    found = []
    for name, below in section.named("sets").items():
        K, M = (_matrix(below, key, order, rows) for key in ("stiffness", "mass"))
        nodes = below.read("nodes", ids) if "nodes" in below else np.zeros(0, int)
        if K is None and M is None and not below.document.incomplete:
            below.error("MD276", "gives neither stiffness nor mass", "give the file of at least one of them")
        elif nodes is not None:
            found.append(ElementGroup(name, K, M, tuple(nodes.tolist())))
    return tuple(found)


def _matrix(section: Section, key: str, order: int, rows: Rows):
    node = section.nodes.get(key)
    if node is None:
        return None
    limits = {"order": order} if order else {}
    contents = read_kept(section.document, node, section.what(key), matrix_files.read_contents, **limits)
    place = named(section.document, node, section.what(key))
    aligned = None if contents is None or place is None else rows.aligned(contents, place, section.what(key))
    return None if aligned is None else aligned[0]
