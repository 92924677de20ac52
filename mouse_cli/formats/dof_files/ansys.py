"""ANSYS (.mapping), written by HBMAT with Mapping=YES: equation number, node, direction (UX ... ROTZ), below a header."""

from mouse_cli.formats.data_files import FileFormat, line_span, natural, reject, text_lines
from mouse_cli.formats.dof_files import Rows


def _read(path: str) -> Rows:
    found: dict[int, tuple[int, str, str, str]] = {}
    for number, line in enumerate(text_lines(path), 1):
        words = line.split()
        if not words or (not found and not words[0].isdigit()):
            continue
        equation = natural(words[0]) if len(words) == 3 else 0
        if not equation or equation in found:
            message = "expected an equation number that stands once, a node and a direction"
            reject("MD252", path, message, "write the file again", line_span(path, number, line))
        found[equation] = (number, line, words[1], words[2])
    if found and max(found) != len(found):
        reject(
            "MD252", path, f"equations 1 to {max(found)} are expected; {len(found)} are named", "write the file again"
        )
    return [found[equation] for equation in sorted(found)]


FORMAT = FileFormat("mapping", _read)
