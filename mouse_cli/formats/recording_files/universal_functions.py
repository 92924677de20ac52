"""Data set 58 of universal files, function at nodal degree of freedom: its head and its numbers."""

import re
from dataclasses import dataclass

import numpy as np

from mouse_cli.formats.recording_files.universal_blocks import Block, lines

_HEAD_LINES = 11
_AXES = "SXYZ"
_FLOAT = re.compile(r"[-+]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eEdD][-+]?[0-9]+)?|[-+]?[nN]a[nN]|[-+]?[iI]nf(?:inity)?")
_MOST = 500_000_000  # values of one function


@dataclass(frozen=True)
class Axis:
    """kind: specific data type, 8 displacement, 11 velocity, 12 acceleration, 13 force, ...; unit: its label, empty for NONE."""

    kind: int
    unit: str


@dataclass(frozen=True)
class NodalFunction:
    """x, y (n,): abscissae and values, y real or complex. type: 1 time response, 4 frequency response, 6 coherence, ...

    output, reference: as decks write a sensor; step: of even abscissae, None for uneven ones. name: first line of the head.
    """

    type: int
    output: str
    reference: str
    x: np.ndarray
    y: np.ndarray
    step: float | None
    abscissa: Axis
    ordinate: Axis
    denominator: Axis
    name: str


def nodal_function(block: Block) -> NodalFunction:
    """The function of a data set 58 or 58b. Raises ValueError where it is damaged."""
    head, at = lines(block.content, 0, _HEAD_LINES)
    type, output, reference = _places(head[5])
    numbers = head[6].split()
    if len(numbers) < 5:
        raise ValueError(f"the head of the function at byte {block.at} is cut short")
    kind, count, even = (int(float(number)) for number in numbers[:3])
    start, step = (float(number.replace("D", "e").replace("d", "e")) for number in numbers[3:5])
    if kind not in (2, 4, 5, 6) or not 0 < count <= _MOST:
        raise ValueError(f"the function at byte {block.at} has data type {kind} and {count} values")
    raw = _binary(block, at, kind, count, even) if block.binary else _text(block, at, kind, count, even)
    x, y = _divided(raw, kind, count, even)
    if even:
        x = start + step * np.arange(count)
    axes = [_axis(line) for line in head[7:10]]
    return NodalFunction(type, output, reference, x, y, step if even else None, *axes, head[0].strip())


def _places(line: str) -> tuple[int, str, str]:
    """Type of the function, response and reference, by columns: Format(2(I5,I10),2(1X,10A1,I10,I4))."""
    type = int(line[:5])
    places = [_sensor(line[at + 11 : at + 21], line[at + 21 : at + 25]) for at in (30, 55)]
    return type, *places


def _sensor(node: str, direction: str) -> str:
    """`12TY`, `12-RZ`, or the number of the node alone for a scalar."""
    number, code = int(node or 0), int(direction or 0)
    if not 1 <= abs(code) <= 6:
        return str(number)
    kind, axis = ("T", abs(code)) if abs(code) <= 3 else ("R", abs(code) - 3)
    return f"{number}{'-' if code < 0 else ''}{kind}{_AXES[axis]}"


def _axis(line: str) -> Axis:
    """Format(I10,3I5,2(1X,20A1)); some programs do not keep to the columns of the labels."""
    label = line[46:].strip() or " ".join(line.split()[5:])
    return Axis(int(float(line[:10].strip() or 0)), "" if label.upper() == "NONE" else label)


def _text(block: Block, at: int, kind: int, count: int, even: int) -> np.ndarray:
    """The numbers of an ASCII data set: parted by blanks, or by columns where they touch one another."""
    body = bytes(block.content[at:]).decode("latin-1").replace("D", "E").replace("d", "e")
    needed = count * _width(kind, even)
    try:
        found = np.array(body.split(), float)
    except ValueError:
        found = np.array(_FLOAT.findall(body), float)
    if len(found) < needed:
        raise ValueError(f"the function at byte {block.at} promises {needed} numbers and holds {len(found)}")
    return found[:needed].reshape(count, -1)


def _width(kind: int, even: int) -> int:
    """Numbers for each value."""
    return (2 if kind in (5, 6) else 1) + (0 if even else 1)


def _binary(block: Block, at: int, kind: int, count: int, even: int) -> np.ndarray:
    """The numbers of a binary data set; the abscissa of uneven ones is single, or, where the bytes are so many, double."""
    fields = [int(word) for word in block.extra.split() if word.isdecimal()]
    order = ">" if fields and fields[0] == 2 else "<"
    if len(fields) > 1 and fields[1] not in (0, 2):
        raise ValueError(
            f"the function at byte {block.at} is in floating-point format {fields[1]}; IEEE 754 (2) is read"
        )
    item = f"{order}f{4 if kind in (2, 5) else 8}"
    held = len(block.content) - at
    abscissa = [] if even else [("x", item if held >= count * 8 * _width(kind, even) else f"{order}f4")]
    record = np.dtype([*abscissa, ("y", item, (2 if kind in (5, 6) else 1,))])
    needed = count * record.itemsize
    if held < needed:
        raise ValueError(f"the function at byte {block.at} promises {needed} bytes and holds {held}")
    if held > needed and bytes(block.content[at : at + 1]) in (b"\n", b"\r"):
        at += _stray(block, at, needed)
    values = np.frombuffer(block.content, record, count, at)
    parts = [values["x"].astype(float)[:, None]] if not even else []
    return np.hstack([*parts, values["y"].astype(float)])


def _stray(block: Block, at: int, needed: int) -> int:
    """Bytes of line ends that some programs write between head and numbers: as many as there are too many."""
    extra = len(block.content) - at - needed
    rest = bytes(block.content[at + needed :])
    return extra if extra <= 2 and rest.strip(b"\r\n \t") else 0


def _divided(raw: np.ndarray, kind: int, count: int, even: int) -> tuple[np.ndarray, np.ndarray]:
    """Abscissae and values."""
    y = raw if even else raw[:, 1:]
    return raw[:, 0] if not even else np.zeros(count), (y[:, 0] + 1j * y[:, 1] if kind in (5, 6) else y[:, 0])
