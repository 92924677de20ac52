"""Harwell-Boeing (.hb, .rsa, .rua, and .matrix of ANSYS HBMAT) and Rutherford-Boeing (.rb) files.

scipy.io.hb_read refuses the symmetric ones, which stiffness and mass matrices are.
Format: I. S. Duff, R. G. Grimes, J. G. Lewis, Users' Guide for the Harwell-Boeing Sparse Matrix Collection, TR/PA/92/86.
"""

import re

import numpy as np

from mouse_cli.formats.data_files import FileFormat, line_span, reject, text_lines
from mouse_cli.formats.matrix_files import MAX_ORDER
from mouse_cli.formats.matrix_files.triangles import completed
from mouse_cli.model.arrays import Matrix

_HELP = "write it again: HBMAT,fname,matrix,,ASCII,STIFF"
_FIELD = re.compile(r"(\d*)[IEDFG](\d+)")


def _read(path: str, _: str | None) -> Matrix:
    lines = text_lines(path)
    if len(lines) < 4:
        reject("MD252", path, "a Harwell-Boeing file has a header of four lines", _HELP)
    cards = _wholes(path, lines, 1, lines[1])
    kind = lines[2][:3].upper()
    rows, columns, entries = _sizes(path, lines)
    _known(path, lines, kind)
    formats = [lines[3][:16], lines[3][16:32], lines[3][32:52]]
    rhs = len(cards) > 4 and cards[4] > 0
    start = 5 if rhs else 4
    blocks = []
    for count, layout, number in zip((columns + 1, entries, entries), formats, cards[1:4], strict=True):
        blocks.append(_numbers(path, lines, start, number, count, layout))
        start += number
    pointer, index = (block.astype(np.int64) for block in blocks[:2])
    if (np.diff(pointer) < 0).any() or pointer[0] != 1 or pointer[-1] != entries + 1:
        reject("MD252", path, "the pointers to the columns do not ascend from 1 to the number of entries", _HELP)
    if entries and not (index.min() >= 1 and index.max() <= rows):
        reject("MD252", path, f"a row index is outside 1 to {rows}", _HELP)
    col = np.repeat(np.arange(columns), np.diff(pointer))
    return _matrix(path, kind, index - 1, col, blocks[2], (rows, columns))


def _matrix(
    path: str, kind: str, row: np.ndarray, col: np.ndarray, values: np.ndarray, shape: tuple[int, int]
) -> Matrix:
    if kind[1] == "S" and shape[0] == shape[1]:
        return completed(path, row, col, values, shape[0])
    from scipy.sparse import coo_array

    return coo_array((values, (row, col)), shape=shape)


def _known(path: str, lines: list[str], kind: str) -> None:
    span = line_span(path, 3, lines[2])
    if kind[:1] in ("C", "P"):
        reject("MD253", path, f"type {kind}: the matrix is complex or a bare pattern; K and M are real", _HELP, span)
    if kind[1:2] in ("Z", "H"):
        reject("MD255", path, f"type {kind}: the matrix is skew-symmetric or Hermitian", _HELP, span)
    if kind not in ("RSA", "RUA", "RRA", "ISA", "IUA"):
        reject("MD252", path, f"type '{kind}' is not read; expected RSA or RUA", _HELP, span)


def _sizes(path: str, lines: list[str]) -> tuple[int, int, int]:
    sizes = _wholes(path, lines, 2, lines[2][14:])
    if len(sizes) < 3 or min(sizes[:3]) < 0:
        reject("MD252", path, "rows, columns and entries are expected", _HELP, line_span(path, 3, lines[2]))
    if max(sizes[:2]) > MAX_ORDER:
        message = f"the matrix is {sizes[0]} x {sizes[1]}; at most {MAX_ORDER} is read"
        reject("MD258", path, message, "condense it", line_span(path, 3, lines[2]))
    return sizes[0], sizes[1], sizes[2]


def _wholes(path: str, lines: list[str], at: int, text: str) -> list[int]:
    """Whole numbers in fields of 14 columns, or between blanks."""
    try:
        words = [text[i : i + 14] for i in range(0, len(text.rstrip()), 14)]
        found = [int(word) for word in words if word.strip()]
        if at == 1 and (len(found) < 4 or min(found) < 0):
            raise ValueError
        return found
    except ValueError:
        reject("MD252", path, "whole numbers are expected", _HELP, line_span(path, at + 1, lines[at]))


def _numbers(path: str, lines: list[str], start: int, number: int, count: int, layout: str) -> np.ndarray:
    """`count` numbers on `number` lines from line `start` (from 0), in the FORTRAN format `layout`."""
    field = _FIELD.search(layout.upper())
    if not field or not int(field[2]):
        message = f"'{layout.strip()[:16]}' is no format of numbers"
        reject("MD252", path, message, _HELP, line_span(path, 4, lines[3]))
    perline, width = int(field[1] or 1), int(field[2])
    rows = lines[start : start + number]
    if len(rows) < number or perline * number < count:
        message = f"{count} numbers on {number} lines from line {start + 1} are promised; the file ends sooner"
        reject("MD252", path, message, _HELP, line_span(path, max(1, len(lines)), lines[-1]))
    words: list[float] = []
    for at, line in enumerate(rows, start):
        take = min(perline, count - len(words))
        fields = line.split()  # of SciPy's writer, which keeps blanks between numbers, but not to the width
        if len(fields) != take:
            fields = [line[i : i + width] for i in range(0, min(take * width, len(line)), width)]
        try:
            if len(fields) != take:
                raise ValueError
            words += [float(field.upper().replace("D", "E")) for field in fields]
        except ValueError:
            message = f"{take} numbers of {width} characters are expected"
            reject("MD252", path, message, _HELP, line_span(path, at + 1, line))
    return np.array(words)


FORMAT = FileFormat("hb", _read, ("hb", "rb", "rsa", "rua", "matrix"))
