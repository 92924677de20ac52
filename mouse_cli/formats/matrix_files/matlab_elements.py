"""The data elements of a MATLAB 5 file, unpacked and looked over before SciPy reads them, whose process an unknown type ends."""

import os
import zlib
from io import BytesIO
from math import prod
from typing import BinaryIO

from mouse_cli.formats.data_files import check_memory

_MATRIX, _COMPRESSED = 14, 15
_TYPES = frozenset((1, 2, 3, 4, 5, 6, 7, 9, 12, 13, _MATRIX, _COMPRESSED, 16, 17, 18))  # MAT-File Format, Table 1-1
# Classes of arrays, Table 1-3
_CELL, _STRUCT, _OBJECT, _TEXT, _SPARSE, _FUNCTION, _OPAQUE = 1, 2, 3, 4, 5, 16, 17
_NUMERIC, _HOLDERS = range(6, 16), (_CELL, _STRUCT, _OBJECT)
_NUMBERS, _LETTERS = (1, 2, 3, 4, 5, 6, 7, 9, 12, 13), (1, 2, 3, 4, 16, 17, 18)  # types of their parts
_HEAD = ((6,), (5, 6), (1, 2, 16))  # flags, dimensions, name
_PARTS = {  # types of the parts of each class, in their order
    _CELL: _HEAD,
    _STRUCT: (*_HEAD, (5,), (1,)),
    _OBJECT: (*_HEAD, (1,), (5,), (1,)),
    _TEXT: (*_HEAD, _LETTERS),
    _SPARSE: (*_HEAD, (5,), (5,), _NUMBERS),
    **dict.fromkeys(_NUMERIC, (*_HEAD, _NUMBERS)),
    _FUNCTION: (*_HEAD, (_MATRIX,)),
    _OPAQUE: ((6,), (1,), (1,), (1,), (_MATRIX,)),
}
Element = tuple[int, int, int]  # type, byte at which its data begin, their size
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
        check_memory(path, 3 * found.tell(), "the unpacked file")
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
    check_memory(
        path, 3 * min(stated, 1032 * len(data)), "an unpacked element"
    )  # deflate packs no better than 1 in 1032
    rest = machine.decompress(machine.unconsumed_tail, stated + 8)
    if len(tag) < 8 or not machine.eof:
        raise ValueError("a compressed element is cut short, or longer than it states")
    return tag + rest


def _elements(stream: BinaryIO, at: int, end: int, order: str, depth: int) -> list[Element]:
    """The elements from byte `at` to `end`, each array among them looked over."""
    if not depth:
        raise ValueError(f"arrays are nested deeper than {_DEEPEST}")
    found: list[Element] = []
    while at + 8 <= end:
        stream.seek(at)
        type = int.from_bytes(stream.read(4), order)
        size, begin = int.from_bytes(stream.read(4), order), at + 8
        if type >> 16:  # a small element: type and size in four bytes, four of data
            type, size, begin = type & 0xFFFF, type >> 16, at + 4
        if type not in _TYPES or type == _COMPRESSED or begin + size > end or (begin == at + 4 and size > 4):
            raise ValueError(f"no data element at byte {at}")
        if type == _MATRIX and size:
            _check(stream, begin, _elements(stream, begin, begin + size, order, depth - 1), order)
        found.append((type, begin, size))
        at = begin + size
        at += -at % 8
    return found


def _check(stream: BinaryIO, at: int, parts: list[Element], order: str) -> None:
    """Raise ValueError where the array at byte `at` has other parts than its class demands: SciPy reads them without a look."""
    kind, is_complex = _flags(stream, at + 8, order)
    if kind not in _PARTS:
        raise ValueError(f"the array at byte {at} is of no class, {kind}")
    wanted = _PARTS[kind] + (_NUMBERS,) * (is_complex and kind in (_SPARSE, *_NUMERIC))
    if len(parts) < len(wanted) or any(part[0] not in types for part, types in zip(parts, wanted, strict=False)):
        raise ValueError(f"the array at byte {at} has no complete class,  {kind}")
    if kind != _OPAQUE and (parts[0][2] != 8 or not 8 <= parts[1][2] <= 128):
        raise ValueError(f"the array at byte {at} has no flags, or less than 2 or more than 32 dimensions")
    if kind in _HOLDERS or kind == _TEXT:
        _full(stream, at, kind, parts, len(wanted), order)


def _full(stream: BinaryIO, at: int, kind: int, parts: list[Element], head: int, order: str) -> None:
    """Raise ValueError where a cell, a struct or a text has fewer parts than its dimensions demand, for which SciPy makes room."""
    count = prod(_wholes(stream, parts[1], order))
    if kind == _TEXT:
        enough = count <= max(parts[3][2], _FREE)
    else:
        names = 1 if kind == _CELL else parts[head - 1][2] // max(1, *_wholes(stream, parts[head - 2], order))
        enough = count <= _FREE and len(parts) - head >= count * names
    if not enough or not all(type == _MATRIX for type, *_ in parts[head:]):
        raise ValueError(f"the array at byte {at} promises {count} elements and has {len(parts) - head}")


def _flags(stream: BinaryIO, at: int, order: str) -> tuple[int, bool]:
    """Class of the array whose flags are at byte `at`, and whether it is complex."""
    stream.seek(at)
    flags = int.from_bytes(stream.read(4), order)
    return flags & 0xFF, bool(flags & 0x800)


def _wholes(stream: BinaryIO, part: Element, order: str) -> list[int]:
    """Whole numbers of four bytes, of which dimensions are at most 32."""
    _, begin, size = part
    stream.seek(begin)
    data = stream.read(min(size, 128))
    return [int.from_bytes(data[i : i + 4], order) for i in range(0, len(data), 4)]
