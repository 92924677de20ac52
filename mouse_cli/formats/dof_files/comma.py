"""A table (.csv) of node and direction, one row for each degree of freedom, with or without a header."""

from mouse_cli.formats.data_files import FileFormat, text_lines
from mouse_cli.formats.dof_files import Rows


def _read(path: str) -> Rows:
    found = []
    for number, line in enumerate(text_lines(path), 1):
        if not line.strip() or line.lstrip().startswith("#"):
            continue
        words = [word.strip() for word in line.replace(";", ",").replace("\t", ",").split(",")]
        if not found and not words[0].isdigit() and words[-1].lower() in ("direction", "dof", "component"):
            continue  # the header
        found.append((number, line, words[0], words[1] if len(words) == 2 else ""))
    return found


FORMAT = FileFormat("csv", _read)
