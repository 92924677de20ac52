"""What the rows of imported matrices are, for a deck that is written: maps beside it, or labels in it."""

import re

from mouse_cli.formats.yaml_deck.text import real, word, wrapped
from mouse_cli.model.geometry import DIRECTIONS
from mouse_cli.model.structure import Structure

_LABEL = re.compile(rf"(\d+)({'|'.join(DIRECTIONS)}|S)")


def rows(structure: Structure, stem: str, attachments: dict[str, str], places: bool) -> list[str]:
    """Lines `dofs:` and `nodes:` and their tables, where there are `places` and labels tell node and direction; else `labels:`."""
    if structure.labels == tuple(str(i + 1) for i in range(structure.n)):
        return []
    parts = [_LABEL.fullmatch(label) for label in structure.labels]
    if not places or structure.geometry is None or None in parts:
        return [f"  labels: {wrapped(map(word, structure.labels), 2)}"]
    dofs, nodes = f"{stem}_dofs.csv", f"{stem}_nodes.csv"
    each = zip(structure.geometry.node_ids.tolist(), structure.geometry.coordinates, strict=True)
    attachments[dofs] = "node,direction\n" + "".join(f"{part[1]},{part[2]}\n" for part in parts)
    attachments[nodes] = "node,x,y,z\n" + "".join(f"{node},{','.join(map(real, place))}\n" for node, place in each)
    return [f"  dofs: {{file: {word(dofs)}}}", f"  nodes: {{file: {word(nodes)}}}"]
