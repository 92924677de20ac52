"""The data elements of a MATLAB 5 file, unpacked and looked over before SciPy reads them, whose process an unknown type ends."""

import os
import zlib
from io import BytesIO
from math import prod
from typing import BinaryIO

from mouse_cli.formats.data_files import room

_MATRIX, _COMPRESSED = 14, 15
_TYPES = frozenset((1, 2, 3, 4, 5, 6, 7, 9, 12, 13, _MATRIX, _COMPRESSED, 16, 17, 18))  # MAT-File Format, Table 1-1
_SPARSE, _NUMERIC = 5, range(6, 16)  # classes of arrays, Table 1-3
_HEADER = 128  # bytes before the first element
_DEEPEST = 50  # arrays in cells and structs
_FREE = 1_000_000  # elements of a cell, a struct or a text that may be promised whatever the bytes are


def checked(path: str) -> str | BinaryIO:
    """What SciPy may read: the file `path`, or its content where elements are compressed.

    Raises ValueError where an element is of no type, longer than what holds it, or promises more than it has; DeckError (MD258)
    where it unpacks to more than memory holds.
    """
    from scipy.io.matlab import matfile_version

    if matfile_version(path)[0] != 1:
        return path
    with open(path, "rb") as stream:
        stream.seek(_HEADER - 2)
        order = "little" if stream.read(2) == b"IM" else "big"
        size = os.path.getsize(path)
        unpacked = _unpacked(path, stream, size, order)
        _elements(unpacked or stream, _HEADER, len(unpacked.getbuffer()) if unpacked else size, order, _DEEPEST)
    return unpacked or path


def _unpacked(path: str, stream: BinaryIO, end: int, order: str) -> BytesIO | None:
    """The file with its compressed elements, which stand at its top, unpacked; None of one without any."""
    stream.seek(0)
    found, packed, at = BytesIO(), False, _HEADER
    found.write(stream.read(_HEADER))
    while at + 8 <= end:
        stream.seek(at)
        tag = stream.read(8)
        type, size = int.from_bytes(tag[:4], order), int.from_bytes(tag[4:], order)
        if type != _COMPRESSED and not packed:
            at += 8 + size + -size % 8
            continue
        if not packed:  # all that stood before it
            stream.seek(_HEADER)
            found.write(stream.read(at - _HEADER))
            stream.seek(at + 8)
            packed = True
        room(path, 3 * found.tell(), "the unpacked file")
        found.write(
            _inflated(path, stream.read(size), order) if type == _COMPRESSED else tag + stream.read(size + -size % 8)
        )
        at += 8 + size + (-size % 8 if type != _COMPRESSED else 0)
    return found if packed else None


def _inflated(path: str, data: bytes, order: str) -> bytes:
    """An element unpacked, which states its own length."""
    machine = zlib.decompressobj()
    tag = machine.decompress(data, 8)
    stated = int.from_bytes(tag[4:], order)
    room(path, 3 * min(stated, 1032 * len(data)), "an unpacked element")  # deflate packs no better than 1 in 1032
    rest = machine.decompress(machine.unconsumed_tail, stated + 8)
    if len(tag) < 8 or not machine.eof:
        raise ValueError("a compressed element is cut short, or longer than it states")
    return tag + rest


def _elements(stream: BinaryIO, at: int, end: int, order: str, depth: int) -> int:
    """Look over the elements from byte `at` to `end`, and count them."""
    if not depth:
        raise ValueError(f"arrays are nested deeper than {_DEEPEST}")
    count = 0
    while at + 8 <= end:
        stream.seek(at)
        type = int.from_bytes(stream.read(4), order)
        size, begin = int.from_bytes(stream.read(4), order), at + 8
        if type >> 16:  # a small element: type and size in four bytes, four of data
            type, size, begin = type & 0xFFFF, type >> 16, at + 4
        if type not in _TYPES or type == _COMPRESSED or begin + size > end:
            raise ValueError(f"no data element at byte {at}")
        if type == _MATRIX:
            parts = _elements(stream, begin, begin + size, order, depth - 1)
            if size and parts < _parts(stream, begin + 8, order):
                raise ValueError(f"the array at byte {at} lacks a part")
            _dimensions(stream, begin, size, order)
        at = begin + size
        at += -at % 8
        count += 1
    return count


def _parts(stream: BinaryIO, at: int, order: str) -> int:
    """Elements of the array whose flags are at byte `at`: flags, dimensions, name, and its numbers where it has them."""
    kind, is_complex = _flags(stream, at, order)
    if kind == _SPARSE:
        return 6 + is_complex
    return 4 + is_complex if kind in _NUMERIC else 3


def _flags(stream: BinaryIO, at: int, order: str) -> tuple[int, bool]:
    """Class of an array, and whether it is complex."""
    stream.seek(at)
    flags = int.from_bytes(stream.read(4), order)
    return flags & 0xFF, bool(flags & 0x800)


def _dimensions(stream: BinaryIO, begin: int, size: int, order: str) -> None:
    """A cell, a struct or a text has no more elements than bytes: SciPy makes room for its dimensions before it reads them."""
    if size < 24 or _flags(stream, begin + 8, order)[0] in (_SPARSE, *_NUMERIC):
        return
    stream.seek(begin + 20)
    length = min(int.from_bytes(stream.read(4), order), size)
    data = stream.read(length)
    count = prod(int.from_bytes(data[i : i + 4], order) for i in range(0, len(data), 4))
    if count > max(size, _FREE):
        raise ValueError(f"the array at byte {begin} promises {count} elements and has {size} bytes")
