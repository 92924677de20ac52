"""CalculiX (.dof), written with SOLVER=MATRIXSTORAGE: node.direction on each line, such as `12.3`."""

from mouse_cli.formats.data_files import FileFormat, text_lines
from mouse_cli.formats.dof_files import Rows


def _read(path: str) -> Rows:
    lines = enumerate(text_lines(path), 1)
    parted = [(number, line, *line.strip().partition(".")) for number, line in lines if line.strip()]
    return [(number, line, node, direction) for number, line, node, _, direction in parted]


FORMAT = FileFormat("dof", _read)
