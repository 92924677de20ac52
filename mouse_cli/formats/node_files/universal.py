"""Universal files (.unv, .uff): nodes of data sets 15 and 2411, others passed over.

Own code rather than pyuff, which takes lines padded to 80 columns with blanks, as some programs write them, for numbers.
"""

from collections.abc import Iterator

from mouse_cli.formats.data_files import FileFormat, line_span, reject, text_lines
from mouse_cli.formats.node_files import Rows

_MARK = "-1"


def _read(path: str) -> Rows:
    found: Rows = []
    for number, lines in _data_sets(path):
        kind = lines[0].strip()
        if kind == "15":
            found += [(at, line, _words(line)) for at, line in enumerate(lines[1:], number + 1) if line.strip()]
        elif kind == "2411":
            body = [(at, line) for at, line in enumerate(lines[1:], number + 1) if line.strip()]
            for (_, label), (at, line) in zip(body[::2], body[1::2], strict=False):
                found.append((at, line, label.split()[:1] + line.split()))
            if len(body) % 2:
                at, line = body[-1]
                reject("MD252", path, "a node without coordinates", "write the file again", line_span(path, at, line))
    return found


def _words(line: str) -> list[str]:
    """Label and coordinates of a line of data set 15, which has three more whole numbers between them."""
    words = line.split()
    return words[:1] + words[4:]


def _data_sets(path: str) -> Iterator[tuple[int, list[str]]]:
    """Number of the first line, and the lines, of each data set between two lines of -1."""
    begun, inside = 0, []
    for number, line in enumerate(text_lines(path), 1):
        if line.strip() != _MARK:
            inside.append(line)
        elif begun:
            if inside:
                yield begun + 1, inside
            begun = 0
        else:
            begun, inside = number, []
    if begun:
        message = "the data set that begins here does not end"
        reject("MD252", path, message, "write the file again", line_span(path, begun, ""))


FORMAT = FileFormat("unv", _read, ("unv", "uff", "uf", "ufb"))
