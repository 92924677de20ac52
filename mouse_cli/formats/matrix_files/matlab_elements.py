"""The data elements of a MATLAB 5 file, looked over before SciPy reads them: an unknown type there ends the process."""

import os
from typing import BinaryIO

_MATRIX, _COMPRESSED = 14, 15
_TYPES = frozenset((1, 2, 3, 4, 5, 6, 7, 9, 12, 13, _MATRIX, _COMPRESSED, 16, 17, 18))  # MAT-File Format, Table 1-1
_SPARSE, _NUMERIC = 5, range(6, 16)  # classes of arrays, Table 1-3
_HEADER = 128  # bytes before the first element


def check(path: str) -> None:
    """Raise ValueError where an element is of no type, or longer than what holds it. Compressed ones have a checksum instead."""
    with open(path, "rb") as stream:
        stream.seek(_HEADER - 2)
        order = "little" if stream.read(2) == b"IM" else "big"
        _elements(stream, _HEADER, os.path.getsize(path), order)


def _elements(stream: BinaryIO, at: int, end: int, order: str) -> int:
    """Look over the elements from byte `at` to `end`, and count them."""
    count = 0
    while at + 8 <= end:
        stream.seek(at)
        type = int.from_bytes(stream.read(4), order)
        size, begin = int.from_bytes(stream.read(4), order), at + 8
        if type >> 16:  # a small element: type and size in four bytes, four of data
            type, size, begin = type & 0xFFFF, type >> 16, at + 4
        if type not in _TYPES or begin + size > end:
            raise ValueError(f"no data element at byte {at}")
        if type == _MATRIX:
            parts = _elements(stream, begin, begin + size, order)
            if size and parts < _parts(stream, begin + 8, order):
                raise ValueError(f"the array at byte {at} lacks a part")
        at = begin + size
        if type != _COMPRESSED:
            at += -at % 8
        count += 1
    return count


def _parts(stream: BinaryIO, at: int, order: str) -> int:
    """Elements of the array whose flags are at byte `at`: flags, dimensions, name, and its numbers where it has them."""
    stream.seek(at)
    flags = int.from_bytes(stream.read(4), order)
    kind, is_complex = flags & 0xFF, bool(flags & 0x800)
    if kind == _SPARSE:
        return 6 + is_complex
    return 4 + is_complex if kind in _NUMERIC else 3
