"""Abaqus *MATRIX OUTPUT, FORMAT=MATRIX INPUT (.mtx): node, dof, node, dof, value on each line; one triangle or both."""

import numpy as np

from mouse_cli.formats.data_files import FileFormat, reject
from mouse_cli.formats.matrix_files import Contents
from mouse_cli.formats.matrix_files.columns import Columns
from mouse_cli.formats.matrix_files.triangles import completed
from mouse_cli.model.dof_map import DofMap
from mouse_cli.model.geometry import DIRECTIONS

_FIXED = 1e36  # a diagonal by which a degree of freedom is held at a boundary condition


def _read(path: str, _: str | None) -> Contents:
    columns = Columns(path, 5, "node, dof, node, dof, value", "**")
    labels, values = columns.whole(slice(0, 4), -(2**31) + 1), columns.table[:, 4]
    _ordinary(path, labels, columns)
    stride = len(DIRECTIONS)
    place = labels[:, 0::2] * stride + labels[:, 1::2] - 1
    dofs, index = np.unique(place, return_inverse=True)
    index = index.reshape(-1, 2)
    matrix = completed(path, index[:, 0], index[:, 1], values, len(dofs), columns.where)
    return _free(matrix, DofMap(dofs // stride, dofs % stride))


def _ordinary(path: str, labels: np.ndarray, columns: Columns) -> None:
    """Nodes above 0, and directions 1 to 6: others are internal, such as Lagrange multipliers, and K is then indefinite."""
    nodes, directions = labels[:, 0::2], labels[:, 1::2]
    internal = np.flatnonzero((nodes < 1).any(axis=1))
    strange = np.flatnonzero(((directions < 1) | (directions > len(DIRECTIONS))).any(axis=1))
    if len(internal):
        message = "a node below 1 is internal to Abaqus, such as a Lagrange multiplier"
        help = "export a model without hybrid elements, distributing couplings and contact"
        reject("MD252", path, message, help, columns.where(int(internal[0])))
    if len(strange):
        span = columns.where(int(strange[0]))
        reject("MD252", path, "directions are 1 to 6", "export a mechanical model", span)


def _free(matrix, dofs: DofMap) -> Contents:
    """Without the degrees of freedom that a penalty on the diagonal holds."""
    fixed = matrix.tocsr().diagonal() == _FIXED
    if not fixed.any():
        return Contents(matrix, dofs)
    keep = np.flatnonzero(~fixed)
    labels = dofs.labels()
    removed = frozenset(labels[i] for i in np.flatnonzero(fixed).tolist())
    return Contents(matrix.tocsr()[keep][:, keep], DofMap(dofs.node[keep], dofs.direction[keep]), removed)


def _claims(head: bytes) -> bool:
    lines = [line for line in head.splitlines() if line.strip() and not line.startswith(b"**")]
    return bool(lines) and lines[0].count(b",") == 4


FORMAT = FileFormat("abaqus", _read, ("mtx",), claims=_claims)
