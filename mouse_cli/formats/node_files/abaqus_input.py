"""Nodes of an Abaqus or CalculiX input deck (.inp): *NODE blocks, in the global rectangular system."""

from mouse_cli.formats.data_files import FileFormat, line_span, reject, text_lines
from mouse_cli.formats.node_files import Rows

_OTHERS = ("SYSTEM=C", "SYSTEM=S", "INPUT=")


def _read(path: str) -> Rows:
    found: Rows = []
    inside = False
    for number, line in enumerate(text_lines(path), 1):
        if line.startswith("**") or not line.strip():
            continue
        if line.lstrip().startswith("*"):
            keyword = line.upper().replace(" ", "")
            inside = keyword == "*NODE" or keyword.startswith("*NODE,")
            if (inside and any(other in keyword for other in _OTHERS)) or keyword.startswith("*SYSTEM"):
                message = "nodes in a file of their own or in another system of coordinates are not read"
                reject("MD252", path, message, "give nodes as .csv: node,x,y,z", line_span(path, number, line))
        elif inside:
            words = [word.strip() for word in line.rstrip(", \t").split(",")]
            found.append((number, line, (words + ["0"] * 3)[:4] if len(words) < 4 else words[:4]))
    return found


FORMAT = FileFormat("inp", _read)
