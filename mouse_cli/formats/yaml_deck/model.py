"""The `model:` of a YAML deck: K and M in any of their forms, and the names of the degrees of freedom."""

from dataclasses import dataclass

import numpy as np

from mouse_cli.formats import matrix_files
from mouse_cli.formats.draft import Entries, MeshDraft, SupportDraft
from mouse_cli.formats.yaml_deck import values as yaml_values
from mouse_cli.formats.yaml_deck.files import read_below
from mouse_cli.formats.yaml_deck.imported import Rows
from mouse_cli.formats.yaml_deck.imported_parts import element_sets, supports
from mouse_cli.formats.yaml_deck.kinds import KINDS
from mouse_cli.formats.yaml_deck.nodes import Document, Node
from mouse_cli.formats.yaml_deck.sections import Section
from mouse_cli.formats.yaml_deck.structure import structure
from mouse_cli.model.arrays import Matrix
from mouse_cli.model.held import ElementGroup


@dataclass
class Model:
    """K, M, C and D as read (None: not given, or refused), their order (0: none is known) and labels; and the structure."""

    where_order: Node
    matrices: dict[str, Entries | Matrix]
    order: int = 0
    labels: tuple[str, ...] = ()
    mesh: MeshDraft | None = None
    rows: Rows | None = None
    supports: tuple[SupportDraft, ...] = ()
    groups: tuple[ElementGroup, ...] = ()


_MATRICES = {"K": "stiffness", "M": "mass", "C": "damping", "D": "structural_damping"}


def model(section: Section) -> Model:
    """The matrices, of one order, and the structure."""
    found, order, first = {}, 0, section.node
    rows = Rows(section)
    for name, key in _MATRICES.items():
        matrix, n, place = _matrix(section, key)
        if isinstance(matrix, matrix_files.Contents):
            if name == "K":
                rows.first(matrix)
            matrix, n = rows.aligned(matrix, place, f"model.{key}") or (None, 0)
        if matrix is not None:
            found[name] = matrix
        if not order:
            order, first, setter = n, place if n else first, key
        elif n and n != order:
            message = f"model.{key} has order {n}, but model.{setter} has order {order}"
            section.document.error("MD220", place, message, "give all matrices the same order")
    labels = _labels(section, order) or rows.labels
    below = section.section("structure")
    on = labels or tuple(str(i + 1) for i in range(order))
    mesh = structure(below, on) if below else None
    held, groups = supports(section, labels), element_sets(section, order, rows)
    return Model(first, found, order, labels, mesh, rows, held, groups)


def _matrix(section: Section, key: str) -> tuple[Entries | matrix_files.Contents | None, int, Node]:
    """The matrix, its order (0: unknown) and the place that set it."""
    below = section.section(key)
    form = below.form() if below else None
    if form is None:
        return None, 0, section.node
    found = _FORMS[form](below, below.nodes[form])
    place = below.nodes["order" if form == "entries" else form]
    return (*found, place) if found else (None, 0, place)


def _entries(section: Section, node: Node) -> tuple[Entries, int] | None:
    order = section.value("order", 0)
    found = yaml_values.entries(section.document, node, section.what("entries"), KINDS["triples"].words)
    return None if found is None or not order else (found, order)


def _diagonal(section: Section, node: Node) -> tuple[Entries, int] | None:
    values = section.value("diagonal")
    if values is None:
        return None
    if not len(values):
        message = f"{section.what('diagonal')} holds no number"
        return section.document.error("MD216", node, message, "give one number for each row")
    index = np.arange(1, len(values) + 1)
    return Entries(index, index, values, section.document.where(node.value)), len(values)


def _identity(section: Section, node: Node) -> tuple[Entries, int] | None:
    order = section.value("identity")
    if order is None:
        return None
    index = np.arange(1, order + 1)
    return Entries(index, index, np.ones(order), lambda _: section.document.span(node)), order


def _dense(section: Section, node: Node) -> tuple[Entries, int] | None:
    values = square(section.document, node, section.what("dense"))
    if values is None or not _symmetric(section.document, node, values, section.what("dense")):
        return None
    row, col = np.nonzero(np.triu(values))
    where = lambda i: section.document.span(node.value[row[i]].value[col[i]])
    return Entries(row + 1, col + 1, values[row, col], where), len(values)


def square(document: Document, node: Node, what: str, order: int | None = None) -> np.ndarray | None:
    """A list of n rows of n numbers; `order` is n when it is known from elsewhere."""
    found = yaml_values.rows(document, node, what, KINDS["square"].words)
    if found is None:
        return None
    nodes, values = found
    n = len(nodes) if order is None else order
    if len(nodes) != n or not n:
        return document.error(
            "MD216", node, f"{what} has {len(nodes)} rows; expected {n or 'some'}", f"give {n or 1} rows"
        )
    wrong = [(row, node) for row, node in zip(values, nodes, strict=True) if len(row) != n]
    for row, place in wrong[:20]:
        message = f"a row of {what} has {len(row)} values; expected {n}, as there are rows"
        document.error("MD216", place, message, f"give {n} values in each row")
    return None if wrong else np.array(values)


def _symmetric(document: Document, node: Node, values: np.ndarray, what: str) -> bool:
    """Whether every element equals its mirror image; a difference of rounding is no slip."""
    close = np.isclose(values, values.T, rtol=1e-9, atol=0, equal_nan=True)
    for i, j in np.argwhere(~close & (np.arange(len(values))[:, None] > np.arange(len(values))))[:20]:
        document.error(
            "MD221",
            node.value[i].value[j],
            f"{what}({i + 1},{j + 1}) is {values[i, j]:.10g}, "
            f"but its mirror image ({j + 1},{i + 1}) is {values[j, i]:.10g}",
            "make the two equal: K and M are symmetric",
        )
    return bool(close.all())


def _file(section: Section, node: Node) -> tuple[matrix_files.Contents, int] | None:
    chosen = {"variable": section.value("variable")} if "variable" in section else {}
    found = read_below(section.document, node, section.called, matrix_files.read_contents, **chosen)
    return None if found is None else (found, found.matrix.shape[0])


_FORMS = {"entries": _entries, "dense": _dense, "diagonal": _diagonal, "identity": _identity, "file": _file}


def _labels(section: Section, order: int) -> tuple[str, ...]:
    labels = section.value("labels", [])
    if not labels:
        return ()
    node, document = section.nodes["labels"], section.document
    if order and len(labels) != order:
        message = f"model.labels has {len(labels)} names; the model has {order} degrees of freedom"
        document.error("MD216", node, message, f"give {order} names")
    seen: set[str] = set()
    for item, label in zip(node.value, labels, strict=True):
        if label in seen:
            document.error("MD226", item, f"label '{label}' is given twice", "give each degree of freedom its own name")
        seen.add(label)
    return tuple(labels)
