"""The `parameters:` and `elements:` of a YAML deck: the properties, and what of K and M they move; one may stand for many."""

from collections.abc import Callable
from math import inf

import numpy as np
import yaml

from mouse_cli.formats import matrix_files
from mouse_cli.formats.draft import Entries, MeshDraft
from mouse_cli.formats.yaml_deck import values as yaml_values
from mouse_cli.formats.yaml_deck.bindings import WHOSE, Bound
from mouse_cli.formats.yaml_deck.files import named, read_kept
from mouse_cli.formats.yaml_deck.ids import ids, ranges
from mouse_cli.formats.yaml_deck.imported import Rows
from mouse_cli.formats.yaml_deck.kinds import KINDS
from mouse_cli.formats.yaml_deck.nodes import QUOTED, Document, Node
from mouse_cli.formats.yaml_deck.sections import Section
from mouse_cli.model.arrays import upper_triangle
from mouse_cli.model.parameter import Parameter

_KEYS = ("stiffness", "mass")


def sections(deck: Section, mesh: MeshDraft | None) -> list[Section]:
    """One section for each parameter; elements of `mesh` that are to be parameters each by itself are parted here."""
    return [
        Section(deck.document, item, "parameter", f"parameters[{i}]")
        for i, given in enumerate(deck.read("parameters", yaml_values.items, "a list of parameters") or [], 1)
        for item in expanded(deck.document, given, f"parameters[{i}]", mesh)
    ]


def parameter(section: Section, variance: float | None, bound: Bound | None) -> Parameter | None:
    """One property; a `variance` from prior.covariance replaces its sd. None when it has no name or sd.

    bound: the elements whose property it is, which then say its nominal value and unit.
    """
    name, nominal = section.value("name"), section.value("nominal", bound.nominal if bound else 0.0)
    sd = _sd(section, nominal, variance)
    if name is None or sd is None:
        return None
    return Parameter(
        name,
        sd,
        nominal,
        section.value("unit", bound.unit if bound else ""),
        section.value("lower", -inf),
        section.value("upper", inf),
        section.value("transform", "identity"),
        section.document.span(section.nodes["name"]),
    )


def _sd(section: Section, nominal: float, variance: float | None) -> float | None:
    node, document = section.nodes.get("sd"), section.document
    from_covariance = None if variance is None else max(variance, 0.0) ** 0.5
    if node is None:
        if variance is None and yaml_values.is_mapping(section.node):
            section.error("MD224", "has no sd", "give sd: the prior standard deviation; 0 holds the parameter")
        return from_covariance
    if nominal == 0 and document.incomplete and any(key in section for key in (*WHOSE, "nominal")):
        return None  # its nominal value, or the elements that give it, could not be read
    sd = fraction_of(document, node, section.what("sd"), abs(nominal))
    if sd is None or variance is None or np.isclose(sd, from_covariance, rtol=1e-6, atol=0):
        return sd
    both = f"{section.what('sd')} is {sd:.8g}, but prior.covariance has {from_covariance:.8g}"
    document.warn("MD224", node, f"{both}; the covariance is used", "give one of the two")
    return from_covariance


def fraction_of(document: Document, node: Node, what: str, whole: float) -> float | None:
    """A number, or a percentage of `whole`; one of 0 is refused."""
    percent = yaml_values.as_percent(node)
    if percent is None:
        return yaml_values.number(document, node, what, KINDS["sd"].words)
    if whole == 0:
        message = f"{what} is {node.value.strip()} of the nominal value, which is 0"
        return document.error("MD223", node, message, "give the standard deviation as a number")
    return percent * whole / 100


def moves(deck: Section, parameters: list[Section], order: int, rows: Rows | None) -> tuple[Entries, Entries]:
    """The listed elements (value 0: stiffness, 1: mass) and A: (listed element, parameter, partial)."""
    listing = deck.section("elements")
    groups = [_moved(parameters, key, order, rows) for key in _KEYS]
    lists = [_listed(deck.document, listing, key, group) for key, (group, _) in zip(_KEYS, groups, strict=True)]
    offset = len(lists[0][0])
    A = joined(
        [
            Entries(index + 1 + start, owner + 1, group.values, group.where)
            for (group, owner), (_, index), start in zip(groups, lists, (0, offset), strict=True)
        ]
    )
    elements = joined(
        [
            Entries(found.rows, found.cols, np.full(len(found), float(is_mass)), found.where)
            for is_mass, (found, _) in enumerate(lists)
        ]
    )
    return elements, A


def joined(parts: list[Entries]) -> Entries:
    """Several lists of entries as one; each entry keeps its place."""
    starts = np.cumsum([0] + [len(part) for part in parts])

    def where(i: int):
        part = int(np.searchsorted(starts, i, side="right")) - 1
        return parts[part].where(i - int(starts[part]))

    gather: Callable = lambda name, dtype: np.concatenate([np.zeros(0, dtype)] + [getattr(p, name) for p in parts])
    return Entries(gather("rows", int), gather("cols", int), gather("values", float), where)


def _moved(parameters: list[Section], key: str, order: int, rows: Rows | None) -> tuple[Entries, np.ndarray]:
    """What all parameters move in one matrix, and which of them (from 0) moves it."""
    parts = [_group(section, key, order, rows) for section in parameters]
    owner = np.repeat(np.arange(len(parts)), [len(part) for part in parts])
    return joined(parts), owner


def _group(section: Section, key: str, order: int, rows: Rows | None) -> Entries:
    """dK or dM of one parameter; no entries when there are none, or after an error."""
    node = section.nodes.get(key)
    found = None
    if node is not None and yaml_values.is_mapping(node):
        found = _group_file(section, node, key, order, rows)
    elif node is not None:
        found = yaml_values.entries(section.document, node, section.what(key), KINDS["triples or file"].words)
    return found or Entries(np.zeros(0, int), np.zeros(0, int), np.zeros(0))


def _group_file(section: Section, node: Node, key: str, order: int, rows: Rows | None) -> Entries | None:
    path = named(section.document, node, section.what(key))
    if path is None:
        return None
    limits = {"order": order} if order else {}
    contents = read_kept(section.document, node, section.what(key), matrix_files.read_contents, **limits)
    aligned = rows.aligned(contents, path, section.what(key)) if contents is not None and rows else None
    if aligned is None:
        return None
    row, col, value = upper_triangle(aligned[0])
    return Entries(row + 1, col + 1, value, lambda _: section.document.span(path))


def _listed(document: Document, listing: Section | None, key: str, moved: Entries) -> tuple[Entries, np.ndarray]:
    """The elements of one matrix in their order, and for each moved entry its element, from 0."""
    given = listing is not None and key in listing
    found = (
        yaml_values.entries(document, listing.nodes[key], f"elements.{key}", KINDS["pairs"].words, 2) if given else None
    )
    if found is not None:
        return found, _looked_up(document, key, found, moved)
    _, first, index = np.unique(_place(moved), return_index=True, return_inverse=True)
    order = np.argsort(first)  # by first appearance, not by place
    rank = np.empty_like(order)
    rank[order] = np.arange(len(order))
    first = first[order]
    elements = Entries(moved.rows[first], moved.cols[first], moved.values[first], lambda i: moved.where(int(first[i])))
    return elements, rank[index]


def _place(entries: Entries) -> np.ndarray:
    """One number for an element and its mirror image."""
    return np.minimum(entries.rows, entries.cols) * 2**31 + np.maximum(entries.rows, entries.cols)


def _looked_up(document: Document, key: str, listed: Entries, moved: Entries) -> np.ndarray:
    """Position in the list of each moved entry; MD222 for each that is not there."""
    if not len(listed) or not len(moved):
        position, absent = np.zeros(len(moved), int), np.arange(len(moved))
    else:
        sorter = np.argsort(_place(listed), kind="stable")
        places = _place(listed)[sorter]
        found = np.minimum(np.searchsorted(places, _place(moved)), len(listed) - 1)
        position, absent = sorter[found], np.flatnonzero(places[found] != _place(moved))
    for i in absent[:20]:
        pair = f"[{moved.rows[i]}, {moved.cols[i]}]"
        message = f"a parameter moves element {pair} of {key}, which elements.{key} does not list"
        document.error("MD222", moved.where(int(i)), message, f"add {pair} to elements.{key}, or leave that list out")
    return position


def expanded(document: Document, item: Node, called: str, mesh: MeshDraft | None) -> list[Node]:
    """The items that `item` stands for: itself, or with `each: k` one for every k of its elements, named after them."""
    if not yaml_values.is_mapping(item):
        return [item]
    given = {key.value: value for key, value in item.value if yaml_values.is_scalar(key)}
    if "each" not in given:
        return [item]
    size = yaml_values.whole(document, given["each"], f"{called}.each")
    if size is None or size < 1 or mesh is None or not {"elements", "name"} <= given.keys():
        if size is not None:
            message = f"{called} gives each: {size}; it divides named elements of a structure into parameters"
            document.error("MD420", given["each"], message, "give each: 1 or more, with name and elements")
        return []
    everything = np.concatenate([np.zeros(0, int), *(s.ids for s in mesh.mesh.elements)])
    numbers = ids(document, given["elements"], f"{called}.elements", everything)
    if numbers is None:
        return []
    if not len(numbers):
        return document.error("MD216", given["elements"], f"{called}.elements stands for none", "give elements") or []
    parts = np.split(numbers, np.arange(size, len(numbers), size))
    return [_of(item, given["name"], ranges(part).strip("[]")) for part in parts]


def _of(item: Node, name: Node, elements: str) -> Node:
    """`item` for some of its `elements` alone."""
    replaced = {"name": f"{name.value} {elements}", "elements": elements}
    pairs = [
        (key, yaml.ScalarNode(QUOTED, replaced[key.value], value.start_mark, value.end_mark))
        if yaml_values.is_scalar(key) and key.value in replaced
        else (key, value)
        for key, value in item.value
        if key.value != "each"
    ]
    return yaml.MappingNode(item.tag, pairs, item.start_mark, item.end_mark)
