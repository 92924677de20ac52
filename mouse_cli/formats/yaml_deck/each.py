"""One item of `parameters:` that stands for many: a parameter for every so many elements."""

import numpy as np
import yaml

from mouse_cli.formats.mesh_draft import MeshDraft
from mouse_cli.formats.yaml_deck import values as yaml_values
from mouse_cli.formats.yaml_deck.ids import ids, ranges
from mouse_cli.formats.yaml_deck.nodes import QUOTED, Document, Node


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
