"""Options of elements: what is no number to revise, in the forms that the element library names."""

from typing import Any

import numpy as np

from mouse_cli.formats.yaml_deck import values as yaml_values
from mouse_cli.formats.yaml_deck.kinds import KINDS
from mouse_cli.formats.yaml_deck.mesh_nodes import vector
from mouse_cli.formats.yaml_deck.nodes import Document, Node
from mouse_cli.formats.yaml_deck.sections import Section
from mouse_cli.model.geometry import DIRECTIONS
from mouse_cli.terms.elements import AXES, END_DIRECTIONS, END_VECTORS, VECTOR, Option


def option(section: Section, key: str, definition: Option) -> Any:
    """The value of the option `key`; None after an error."""
    node, what, document = section.nodes[key], section.what(key), section.document
    if definition.form in _FORMS:
        return _FORMS[definition.form](document, node, what)
    word = section.value(key)
    if word is None or not definition.choices or word in definition.choices:
        return word
    message = f"{what} is '{word}'; expected one of {', '.join(definition.choices)}"
    return document.error("MD214", node, message, f"give one of {', '.join(definition.choices)}")


def directions(document: Document, node: Node, what: str) -> tuple[int, ...] | None:
    """Indices into DIRECTIONS of a list such as [TX, RZ]."""
    names = yaml_values.texts(document, node, what, KINDS["direction"].words)
    if names is None:
        return None
    for item, name in zip(node.value, names, strict=True):
        if name not in DIRECTIONS:
            yaml_values.mistyped(document, item, f"a direction in {what}", ", ".join(DIRECTIONS))
            return None
    return tuple(DIRECTIONS.index(name) for name in names)


def _vector(document: Document, node: Node, what: str) -> list[float] | None:
    found = vector(document, node, what)
    if found is None:
        return None
    if not np.isfinite(found).all():
        return document.error("MD302", node, f"{what} is not finite", "give finite numbers")
    return found.tolist()


def _axes(document: Document, node: Node, what: str) -> list[list[float]] | None:
    if not yaml_values.is_list(node) or len(node.value) != 2:
        return yaml_values.mistyped(document, node, what, KINDS["two vectors"].words)
    found = [_vector(document, item, what) for item in node.value]
    if None in found:
        return None
    if np.linalg.norm(np.cross(*found)) == 0:
        return document.error("MD408", node, f"{what} are two vectors of one direction", "give two that span a plane")
    return found


def _ends(document: Document, node: Node, what: str, words: str, read: Any) -> dict[int, Any] | None:
    if not yaml_values.is_mapping(node):
        return yaml_values.mistyped(document, node, what, words)
    found = {}
    for key, value in node.value:
        if key.value not in ("1", "2"):
            return yaml_values.mistyped(document, key, f"an end in {what}", "1 or 2")
        found[int(key.value)] = read(document, value, what)
    return None if None in found.values() else found


def _end_vectors(document: Document, node: Node, what: str) -> dict[int, list[float]] | None:
    return _ends(document, node, what, KINDS["end vectors"].words, _vector)


def _end_directions(document: Document, node: Node, what: str) -> dict[int, list[str]] | None:
    found = _ends(document, node, what, KINDS["end directions"].words, directions)
    return None if found is None else {end: [DIRECTIONS[d] for d in listed] for end, listed in found.items()}


_FORMS = {VECTOR: _vector, AXES: _axes, END_VECTORS: _end_vectors, END_DIRECTIONS: _end_directions}
