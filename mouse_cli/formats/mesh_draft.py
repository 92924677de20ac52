"""A structure as a reader took it from a file, with the places of its parts."""

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from mouse_cli._span import Span
from mouse_cli.model.mesh import Binding, Mesh


@dataclass
class MeshDraft:
    """mesh, bindings: as read. node_place(i): place of node index i; element_place(s, i): of element i of set s; span: of all.

    labels: names of the degrees of freedom of a matrix model whose degrees of freedom are the nodes of the mesh, else empty.
    """

    mesh: Mesh
    span: Span
    node_place: Callable[[int], Span]
    element_place: Callable[[int, int], Span]
    bindings: list[Binding] = field(default_factory=list)
    labels: tuple[str, ...] = ()

    def of_element(self, number: int) -> Span:
        """Place of the element called `number`."""
        for s, members in enumerate(self.mesh.elements):
            found = np.flatnonzero(members.ids == number)
            if len(found):
                return self.element_place(s, int(found[0]))
        return self.span

    def of_node(self, number: int) -> Span:
        """Place of the node called `number`."""
        found = np.flatnonzero(self.mesh.node_ids == number)
        return self.node_place(int(found[0])) if len(found) else self.span
