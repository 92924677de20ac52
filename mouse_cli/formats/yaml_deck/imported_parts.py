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
from mouse_cli.model.arrays import Matrix
from mouse_cli.model.geometry import DIRECTIONS
from mouse_cli.model.held import ElementGroup, Thickness

_SUM, _LARGEST = 1e-9, 10  # relative error of a sum of parts; power of a thickness


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
            thickness = _thickness(below, order, rows, {"stiffness": K, "mass": M})
            found.append(ElementGroup(name, K, M, tuple(nodes.tolist()), thickness, _missing(below, order, rows)))
    return tuple(found)


def _missing(section: Section, order: int, rows: Rows) -> tuple[Matrix | None, Matrix | None] | None:
    """What K and M lose without a set."""
    given = section.section("missing")
    return None if given is None else tuple(_matrix(given, key, order, rows) for key in ("stiffness", "mass"))


def _thickness(section: Section, order: int, rows: Rows, whole: dict) -> Thickness | None:
    """What a set gives by powers of its thickness, which sums to `whole`, K and M by key."""
    given = section.section("thickness")
    if given is None:
        return None
    by: dict[str, dict[float, Matrix]] = {"stiffness": {}, "mass": {}}
    for name, below in given.named("powers").items():
        n = _power(below, name)
        for key, found in by.items():
            matrix = _matrix(below, key, order, rows)
            if matrix is not None and n is not None:
                found[n] = matrix
    nominal = given.value("nominal")
    if nominal is None or section.document.incomplete:
        return None
    if nominal <= 0:
        return section.document.error("MD276", given.nodes["nominal"], f"{given.what('nominal')} is {nominal:g}",
                                      "give the thickness of the shells in the model")  # fmt: skip
    for key, found in by.items():
        left, all_ = sum(found.values()), whole[key]
        if found and (all_ is None or not abs(left - all_).max() <= _SUM * abs(all_).max()):
            message = f"the {key} of {given.called} by powers does not sum to that of the set"
            section.document.error("MD276", given.node, message, "give K_n and M_n at the nominal thickness")
    return Thickness(nominal, given.value("unit", ""), by["stiffness"], by["mass"])


def _power(section: Section, name: str) -> float | None:
    try:
        n = float(name)
    except ValueError:
        n = 0.0
    if not 0 < abs(n) <= _LARGEST:
        message = f"'{name[:20]}' is no power of a thickness"
        return section.document.error("MD276", section.node, message, "give a number such as 1 or 3")
    return n


def _matrix(section: Section, key: str, order: int, rows: Rows):
    node = section.nodes.get(key)
    if node is None:
        return None
    limits = {"order": order} if order else {}
    contents = read_kept(section.document, node, section.what(key), matrix_files.read_contents, **limits)
    place = named(section.document, node, section.what(key))
    aligned = None if contents is None or place is None else rows.aligned(contents, place, section.what(key))
    return None if aligned is None else aligned[0]
