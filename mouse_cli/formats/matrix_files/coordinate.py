"""Row, column, value on each line, from 1: CalculiX (.sti, .mas) and Abaqus FORMAT=COORDINATE (.mtx)."""

from mouse_cli.formats.data_files import FileFormat
from mouse_cli.formats.matrix_files.columns import Columns
from mouse_cli.formats.matrix_files.triangles import completed, order
from mouse_cli.model.arrays import Matrix


def _read(path: str, _: str | None) -> Matrix:
    """One triangle or both; CalculiX writes the upper one with its explicit zeros."""
    columns = Columns(path, 3, "row, column, value", "**")
    index, values = columns.whole(slice(0, 2), 1), columns.table[:, 2]
    n = order(path, int(index.max()))
    return completed(path, index[:, 0] - 1, index[:, 1] - 1, values, n, columns.where)


def _claims(head: bytes) -> bool:
    """Three numbers on the first line."""
    lines = [line for line in head.splitlines() if line.strip() and not line.startswith(b"**")]
    words = lines[0].replace(b",", b" ").split() if lines else []
    return len(words) == 3 and words[0].isdigit() and words[1].isdigit()


FORMAT = FileFormat("coordinate", _read, ("sti", "mas", "mtx"), claims=_claims)
