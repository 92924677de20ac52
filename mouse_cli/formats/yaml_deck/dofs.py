"""Degrees of freedom as a deck names them: numbers, or labels of the model."""

import numpy as np

from mouse_cli.formats.yaml_deck import values as yaml_values
from mouse_cli.formats.yaml_deck.kinds import KINDS
from mouse_cli.formats.yaml_deck.nodes import Document, Node


def dofs(document: Document, node: Node, what: str, labels: tuple[str, ...]) -> np.ndarray | None:
    """Degrees of freedom from 1: a plain number is one, anything else is a label of the model."""
    nodes = yaml_values.items(document, node, what, KINDS["dofs"].words)
    if nodes is None:
        return None
    place = {label: i for i, label in enumerate(labels, 1)}
    found = [_dof(document, item, what, place) for item in nodes]
    return None if None in found else np.array(found, dtype=int)


def _dof(document: Document, node: Node, what: str, place: dict[str, int]) -> int | None:
    if yaml_values.as_number(node) is not None:
        return yaml_values.whole(document, node, f"a number in {what}")
    name = yaml_values.text(document, node, f"a value in {what}", "the number or the label of a degree of freedom")
    if name is None or name in place:
        return place.get(name)
    known = f"the labels are {', '.join(list(place)[:12])}" if place else "the model has no labels"
    message = f"{what} names '{name[:40]}', which is no label of the model; {known}"
    return document.error(
        "MD225", node, message, "give the number of the degree of freedom, or a label of model.labels"
    )
