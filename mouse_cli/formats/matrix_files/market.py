"""Matrix Market files (.mtx), the exchange format of NIST: coordinate or array, real or integer."""

import os
from io import BytesIO

import numpy as np

from mouse_cli._span import Span
from mouse_cli.formats.data_files import FileFormat, check_memory, reject
from mouse_cli.formats.matrix_files import MAX_ORDER
from mouse_cli.model.arrays import Matrix, upper_triangle

_HELP = "begin with '%%MatrixMarket matrix coordinate real symmetric' and a line of rows, columns, entries"
_CHUNK = 1 << 20
_SHORTEST_ENTRY, _SHORTEST_VALUE = 6, 2  # "1 1 1\n", "1\n"


def _read(path: str, _: str | None) -> Matrix:
    _check_header(path)
    from scipy.io import mmread

    try:
        return mmread(_ended(path))
    except (ValueError, OverflowError, TypeError, IndexError) as error:
        reject("MD252", path, f"not a Matrix Market file: {str(error)[:200]}", _HELP)


def _ended(path: str) -> str | BytesIO:
    """The file; or its content and a line end where it has none: SciPy's compiled reader looks for one beyond the last byte.

    It follows a zero byte out of the file too.
    """
    last = b""
    with open(path, "rb") as stream:
        for part in iter(lambda: stream.read(_CHUNK), b""):
            if b"\0" in part:
                reject("MD252", path, "not a Matrix Market file: a zero byte stands in it", "write the file again")
            last = part[-1:]
        if last == b"\n":
            return path
        stream.seek(0)
        return BytesIO(stream.read() + b"\n")


def _check_header(path: str) -> None:
    """The size line must be one that the rest of the file can keep: the reader allocates what it promises."""
    with open(path, "rb") as stream:
        banner = stream.readline(1024)
        words = banner.decode("latin-1").lower().split()
        _check_banner(path, words, banner)
        line, number = _size_line(stream)
        rest = os.path.getsize(path) - stream.tell()
    span = Span(path, number, 1, max(1, len(line)), line)
    sizes = [int(word) for word in line.split() if word.isascii() and word.isdigit() and len(word) < 16]
    if len(sizes) != (3 if words[2] == "coordinate" else 2):
        reject("MD252", path, f"the size line reads '{line[:60]}'", _HELP, span)
    if max(sizes[:2]) > MAX_ORDER:
        message = f"the matrix is {sizes[0]} x {sizes[1]}; at most {MAX_ORDER} is read"
        reject("MD258", path, message, "condense it", span)
    least = _least_bytes(words, sizes)
    check_memory(path, 16 * min(least // _SHORTEST_VALUE, rest))
    if least > rest + 1:
        message = f"the size line '{line[:60]}' promises at least {least} bytes, but {rest} follow"
        reject("MD252", path, message, "the file is truncated, or its size line wrong: write it again", span)


def _check_banner(path: str, words: list[str], banner: bytes) -> None:
    text = banner.decode("latin-1").rstrip()
    span = Span(path, 1, 1, max(1, len(text[:80])), text[:200])
    if words[:2] != ["%%matrixmarket", "matrix"] or len(words) != 5 or words[2] not in ("coordinate", "array"):
        reject("MD252", path, "the first line is not that of a Matrix Market file", _HELP, span)
    if words[3] not in ("real", "integer", "double"):
        reject("MD253", path, f"the matrix is '{words[3]}'; K and M are real", "write it as real", span)
    if words[4] not in ("general", "symmetric"):
        reject("MD255", path, f"the matrix is '{words[4]}'; K and M are symmetric", "write it as symmetric", span)


def _size_line(stream) -> tuple[str, int]:
    """The first line that is neither blank nor a comment, and its number."""
    number = 1
    for raw in iter(lambda: stream.readline(4096), b""):
        number += 1
        text = raw.decode("latin-1").rstrip()
        if text and not text.startswith("%"):
            return text, number
    return "", number


def _least_bytes(words: list[str], sizes: list[int]) -> int:
    if words[2] == "coordinate":
        return sizes[2] * _SHORTEST_ENTRY
    rows, columns = sizes
    count = rows * (rows + 1) // 2 if words[4] == "symmetric" else rows * columns
    return count * _SHORTEST_VALUE


def text(matrix: Matrix, comment: str = "") -> str:
    """A symmetric matrix as a Matrix Market file: the lower triangle, each number read back exactly."""
    row, col, values = upper_triangle(matrix)  # its mirror image is the lower triangle, column by column
    lines = ["%%MatrixMarket matrix coordinate real symmetric", *([f"% {comment}"] if comment else [])]
    lines.append(f"{matrix.shape[0]} {matrix.shape[1]} {len(row)}")
    triples = zip((col + 1).tolist(), (row + 1).tolist(), np.asarray(values, dtype=float).tolist(), strict=True)
    lines += [f"{i} {j} {value!r}" for i, j, value in triples]
    return "\n".join(lines) + "\n"


FORMAT = FileFormat("mtx", _read)
