"""The `nodes:` of a structure: one by one, on lines, or from tables."""

from collections.abc import Callable
from dataclasses import dataclass
from itertools import islice

import numpy as np

from mouse_cli._span import Span
from mouse_cli.formats.yaml_deck import values as yaml_values
from mouse_cli.formats.yaml_deck.files import read_below
from mouse_cli.formats.yaml_deck.ids import MOST
from mouse_cli.formats.yaml_deck.kinds import KINDS, MAX_WHOLE
from mouse_cli.formats.yaml_deck.nodes import Document, Node
from mouse_cli.formats.yaml_deck.sections import Section
from mouse_cli.formats.yaml_deck.tables import read_table

_WORDS = KINDS["positions"].words


@dataclass
class Nodes:
    """ids (k,), coordinates (k, 3), and the place of the i-th."""

    ids: np.ndarray
    coordinates: np.ndarray
    where: Callable[[int], Span]

    def __len__(self) -> int:
        return len(self.ids)


def nodes(document: Document, node: Node, what: str) -> Nodes:
    """All blocks of `nodes:` as one; each number stands once."""
    blocks = node.value if yaml_values.is_list(node) else [node]
    parts = [_block(document, block, what) for block in blocks]
    parts = [part for part in parts if part is not None]
    starts = np.cumsum([0] + [len(part) for part in parts])

    def where(i: int) -> Span:
        part = int(np.searchsorted(starts, i, side="right")) - 1
        return parts[part].where(i - int(starts[part]))

    ids = np.concatenate([np.zeros(0, int), *(part.ids for part in parts)])
    found = Nodes(ids, np.concatenate([np.zeros((0, 3)), *(part.coordinates for part in parts)]), where)
    return _once(document, found)


def _once(document: Document, found: Nodes) -> Nodes:
    """MD404 for each number that stands twice."""
    _, first = np.unique(found.ids, return_index=True)
    again = np.setdiff1d(np.arange(len(found)), first)
    for i in again[:20]:
        document.error(
            "MD404", found.where(int(i)), f"node {found.ids[i]} is given twice", "give each node its own number"
        )
    return found if not len(again) else Nodes(found.ids[first], found.coordinates[first], found.where)


def _block(document: Document, node: Node, what: str) -> Nodes | None:
    if not yaml_values.is_mapping(node) or not node.value:
        return yaml_values.mistyped(document, node, what, _WORDS)
    if all(yaml_values.as_number(key) is None for key, _ in node.value):
        section = Section(document, node, "node_block", what)
        form = section.form()
        return None if form is None else {"line": _line, "file": _file}[form](section)
    return _inline(document, node, what)


def _inline(document: Document, node: Node, what: str) -> Nodes | None:
    """{1: [x, y, z], ...}"""
    keys = [key for key, _ in node.value]
    ids = yaml_values.plain_numbers(keys)
    if ids is None or (ids != np.floor(ids)).any() or (ids < 0).any() or (ids > MAX_WHOLE).any():
        wrong = (key for key in keys if not _is_whole(yaml_values.as_number(key)))
        for key in islice(wrong, 20):
            yaml_values.mistyped(document, key, f"a node in {what}", f"the number of a node, 0 to {MAX_WHOLE}")
        return None
    values = [value for _, value in node.value]
    if all(yaml_values.is_list(value) and len(value.value) == 3 for value in values):
        flat = yaml_values.plain_numbers([item for value in values for item in value.value])
        if flat is not None:
            return Nodes(ids.astype(int), flat.reshape(-1, 3), lambda i: document.span(keys[i]))
    rows = [vector(document, value, f"node {key.value}") for key, value in node.value]
    if any(row is None for row in rows):
        return None
    return Nodes(ids.astype(int), np.array(rows), lambda i: document.span(keys[i]))


def _is_whole(number: float | None) -> bool:
    return number is not None and number.is_integer() and 0 <= number <= MAX_WHOLE


def vector(document: Document, node: Node, what: str) -> np.ndarray | None:
    """[x, y, z] as an array (3,); z = 0 when it is not given."""
    if not yaml_values.is_list(node) or not 2 <= len(node.value) <= 3:
        return yaml_values.mistyped(document, node, what, KINDS["vector"].words)
    found = yaml_values.numbers(document, node, what)
    return None if found is None else np.append(found, np.zeros(3 - len(found)))


def _line(section: Section) -> Nodes | None:
    line = section.section("line")
    first, last = line.value("from"), line.value("to")
    ends = [vector(line.document, line.nodes[key], line.what(key)) for key in ("start", "end") if key in line]
    if first is None or last is None or len(ends) < 2 or any(end is None for end in ends):
        return None
    if last < first or last - first >= MOST:
        message = f"{line.called} goes from {first} to {last}"
        help = f"give the lower number as from, and at most {MOST} nodes"
        return line.document.error("MD409", line.node, message, help)
    share = np.linspace(0.0, 1.0, last - first + 1)[:, None]
    with np.errstate(over="ignore", invalid="ignore"):  # what is not finite is told of later
        coordinates = ends[0] * (1 - share) + ends[1] * share
    return Nodes(np.arange(first, last + 1), coordinates, lambda _: line.document.span(line.node))


def _file(section: Section) -> Nodes | None:
    node, document = section.nodes["file"], section.document
    table = read_below(document, node, section.called, read_table, least=3)
    if table is None:
        return None
    values = np.hstack([table.values[:, :4], np.zeros((len(table.values), max(0, 4 - table.values.shape[1])))])
    ids = values[:, 0]
    if (ids != np.floor(ids)).any() or (ids < 0).any() or (ids > MAX_WHOLE).any():
        message = f"{section.what('file')} has numbers of nodes that are no whole numbers"
        return document.error("MD419", node, message, "give id, x, y, z in each line")
    return Nodes(ids.astype(int), values[:, 1:], lambda _: document.span(node))
