"""What the rows of imported matrices are: their nodes and directions, and matrices brought to one order of rows."""

import numpy as np

from mouse_cli.formats.dof_files import read_dofs
from mouse_cli.formats.matrix_files import LARGEST_DENSE, Contents
from mouse_cli.formats.node_files import read_nodes
from mouse_cli.formats.yaml_deck.files import read_kept
from mouse_cli.formats.yaml_deck.nodes import Node
from mouse_cli.formats.yaml_deck.sections import Section
from mouse_cli.model.arrays import Matrix
from mouse_cli.model.dof_map import DofMap
from mouse_cli.model.geometry import Geometry

_SHOWN = 4  # labels that a message lists


class Rows:
    """Rows of the model: `dofs` by model.dofs, else as the file of the stiffness names them; None while nothing names them."""

    def __init__(self, section: Section):
        self.section = section
        self.removed: frozenset[str] = frozenset()
        self.dofs: DofMap | None = self._kept("dofs", read_dofs)
        if self.dofs is not None and "labels" in section:
            message = "model.labels and model.dofs both name the degrees of freedom"
            section.document.error("MD262", section.nodes["labels"], message, "give one of the two")

    @property
    def labels(self) -> tuple[str, ...]:
        """Names such as `12TY`; none while nothing names the rows."""
        return self.dofs.labels() if self.dofs is not None else ()

    def first(self, contents: Contents) -> None:
        """Let the file of the stiffness name the rows, unless model.dofs does."""
        if self.dofs is None:
            self.dofs, self.removed = contents.dofs, contents.removed

    def aligned(self, contents: Contents, place: Node, what: str) -> tuple[Matrix, int] | None:
        """The matrix in the order of the rows, and its order; None after an error.

        A file that names its rows may name them in another order, or a part of them; the rest is zero.
        """
        n = contents.matrix.shape[0]
        if contents.dofs is None:
            if self.dofs is not None and n != len(self.dofs):
                message = f"{what} has order {n}, but {len(self.dofs)} degrees of freedom are named"
                return self._error(place, message, "give the map that was written with the matrices")
            return contents.matrix, n
        if self.dofs is None:
            message = f"the file of {what} names its degrees of freedom, and nothing names those of the model"
            return self._error(place, message, "give model.dofs")
        return self._placed(contents, place, what)

    def _placed(self, contents: Contents, place: Node, what: str) -> tuple[Matrix, int] | None:
        own, names = self.labels, contents.dofs.labels()
        if own == names:
            return contents.matrix, len(own)
        position = {label: i for i, label in enumerate(own)}
        strange = [label for label in names if label not in position and label not in self.removed]
        if strange:
            listed = ", ".join(strange[:_SHOWN]) + (
                f" and {len(strange) - _SHOWN} more" if len(strange) > _SHOWN else ""
            )
            return self._error(place, f"{what} names {listed}, which the model has not", "export all from one model")
        kept = np.array([i for i, label in enumerate(names) if label in position], dtype=int)
        to = np.array([position[names[i]] for i in kept], dtype=int)
        return _embedded(contents.matrix[kept][:, kept], to, len(own)), len(own)

    def geometry(self) -> Geometry | None:
        """Nodes and degrees of freedom of the model, when model.nodes says where the nodes are."""
        found = self._kept("nodes", read_nodes)
        if found is None:
            return None
        node, (ids, coordinates) = self.section.nodes["nodes"], found
        if self.dofs is None:
            message = "model.nodes gives the positions of nodes, but not the degrees of freedom on them"
            return self._error(node, message, "give model.dofs")
        absent = np.setdiff1d(self.dofs.node[self.dofs.direction >= 0], ids)
        if len(absent):
            message = f"model.nodes has no coordinates of {len(absent)} nodes with degrees of freedom, first of node {absent[0]}"
            note = "some programs add nodes of their own, such as those of incompatible modes"
            self.section.document.warn("MD264", node, message, "check that the file is of the same model", note)
        return self.dofs.geometry(ids, coordinates)

    def _kept(self, key: str, read):
        node = self.section.nodes.get(key)
        return None if node is None else read_kept(self.section.document, node, self.section.what(key), read)

    def _error(self, place: Node, message: str, help: str) -> None:
        self.section.document.error("MD262", place, message, help)


def _embedded(matrix: Matrix, to: np.ndarray, n: int) -> Matrix:
    """The matrix (n, n) that has `matrix` in the rows and columns `to`, and zeros elsewhere."""
    from scipy.sparse import coo_array, csr_array

    stored = coo_array(matrix)
    placed = csr_array((stored.data, (to[stored.row], to[stored.col])), shape=(n, n))
    return placed.toarray() if n <= LARGEST_DENSE else placed
