"""Degrees of freedom as a deck names them: numbers, or labels of the model."""

import numpy as np

from mouse_cli.formats.yaml_deck import values as yaml_values
from mouse_cli.formats.yaml_deck.kinds import KINDS
from mouse_cli.formats.yaml_deck.nodes import Document, Node
from mouse_cli.formats.yaml_deck.sensors import place


def dofs(document: Document, node: Node, what: str, labels: tuple[str, ...]) -> np.ndarray | None:
    """Degrees of freedom from 1: a plain number is one, anything else is a label of the model."""
    nodes = yaml_values.items(document, node, what, KINDS["dofs"].words)
    if nodes is None:
        return None
    index = {label: i for i, label in enumerate(labels, 1)}
    found = [_dof(document, item, what, index) for item in nodes]
    return None if None in found else np.array(found, dtype=int)


def _dof(document: Document, node: Node, what: str, index: dict[str, int]) -> int | None:
    name = place(document, node, what)
    if name is None or isinstance(name, int) or name in index:
        return index.get(name, name)
    known = f"the labels are {', '.join(list(index)[:12])}" if index else "the model has no labels"
    message = f"{what} names '{name[:40]}', which is no label of the model; {known}"
    return document.error(
        "MD225", node, message, "give the number of the degree of freedom, or a label of model.labels"
    )
