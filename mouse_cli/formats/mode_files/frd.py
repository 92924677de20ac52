"""Results of CalculiX (.frd): the displacements of the modes of a *FREQUENCY step, as `*NODE FILE` with U writes them.

Text in its short and long form (numbers of nodes in 5 or 10 columns), after the manual of CalculiX GraphiX, "Result Format".
"""

import numpy as np

from mouse_cli.formats.data_files import FileFormat, line_span, reject, text_lines
from mouse_cli.formats.mode_files import ModeTable
from mouse_cli.model.geometry import DIRECTIONS

_BLOCK, _MODES, _VALUES = "  100C", "MODAL", slice(12, 24)
_NODE = {0: 5, 1: 10}  # columns of a number of a node, by the code of the form
_WIDTH = 12  # columns of a value


def _read(path: str) -> ModeTable:
    lines = text_lines(path)
    heads = [i for i, line in enumerate(lines) if line.startswith(_BLOCK) and _MODES in line]
    found = []
    for head in heads:
        name = lines[head + 1][5:13].strip() if head + 1 < len(lines) else ""
        if name == "DISP":
            found.append((_number(path, lines, head, _VALUES), _displacements(path, lines, head)))
    if not found:
        help = "request them: *NODE FILE with U below *FREQUENCY"
        reject("MD624", path, "the file has no mode shapes: displacements of a *FREQUENCY step", help)
    nodes = sorted({node for _, values in found for node in values})
    raw = np.array([[values.get(node, (np.nan,) * 3) for node in nodes] for _, values in found])
    shapes = np.moveaxis(raw, 0, -1).reshape(3 * len(nodes), len(found))
    names = [f"{node}{direction}" for node in nodes for direction in DIRECTIONS[:3]]
    moves = np.flatnonzero(np.nan_to_num(shapes).any(axis=1))  # zeros are written of what is held
    hz = np.array([frequency for frequency, _ in found])
    table = ModeTable(tuple(names[i] for i in moves), hz, np.full(len(hz), np.nan), shapes[moves])
    return table.ascending()


def _number(path: str, lines: list[str], at: int, columns: slice) -> float:
    try:
        return float(lines[at][columns])
    except ValueError:
        _damaged(path, lines, at, f"expected a number in columns {columns.start + 1}-{columns.stop}")


def _displacements(path: str, lines: list[str], head: int) -> dict[int, tuple[float, ...]]:
    """Values (3) of every node of the block that begins on the line `head`, from 0."""
    form = lines[head].split()[-1]
    if form not in ("0", "1"):
        _damaged(path, lines, head, "the results are binary")
    first, found, at = 3 + _NODE[int(form)], {}, head + 1
    while at < len(lines) and not lines[at].startswith(" -3"):
        if lines[at].startswith(" -1"):
            columns = [slice(first + _WIDTH * k, first + _WIDTH * (k + 1)) for k in range(3)]
            try:
                node = int(lines[at][3:first])
            except ValueError:
                _damaged(path, lines, at, f"expected the number of a node in columns 4-{first}")
            found[node] = tuple(_number(path, lines, at, each) for each in columns)
        at += 1
    if at == len(lines) or not found:
        _damaged(path, lines, min(at, len(lines) - 1), "the displacements are cut short")
    return found


def _damaged(path: str, lines: list[str], at: int, message: str) -> None:
    """Raise DeckError (MD252) with the line, from 0."""
    reject("MD252", path, message, "write the results again, as text", line_span(path, at + 1, lines[at]))


FORMAT = FileFormat("frd", _read)
