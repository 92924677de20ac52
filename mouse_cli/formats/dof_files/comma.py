"""A table (.csv) of node and direction, one row for each degree of freedom, with or without a header."""

from mouse_cli.formats.data_files import text_lines
from mouse_cli.formats.dof_files import DofFormat


def _read(path: str) -> list[tuple[int, str, str, str]]:
    found = []
    for number, line in enumerate(text_lines(path), 1):
        if not line.strip() or line.lstrip().startswith("#"):
            continue
        words = [word.strip() for word in line.replace(";", ",").replace("\t", ",").split(",")]
        if not found and not words[0].isdigit() and words[-1].lower() in ("direction", "dof", "component"):
            continue  # the header
        found.append((number, line, words[0], words[1] if len(words) == 2 else ""))
    return found


FORMAT = DofFormat("csv", _read)
