"""A table (.csv) of node number, x, y and z, with or without a header."""

from mouse_cli.formats.data_files import FileFormat, text_lines
from mouse_cli.formats.node_files import Rows


def _read(path: str) -> Rows:
    found: Rows = []
    for number, line in enumerate(text_lines(path), 1):
        words = [word.strip() for word in line.replace(";", ",").replace("\t", ",").split(",")]
        if not line.strip() or line.lstrip().startswith("#") or (not found and words[-1].lower() == "z"):
            continue
        found.append((number, line, words))
    return found


FORMAT = FileFormat("csv", _read)
