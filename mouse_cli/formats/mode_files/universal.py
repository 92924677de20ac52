"""Universal files (.unv, .uff): mode shapes of data sets 55 and 2414, data at nodes, and the units of 164.

Real and complex modes (analysis types 2, 3 and 7); other data sets are passed over. Own code, as for data sets 58: pyuff says of a
damaged one no more than its number.
"""

import re
from dataclasses import dataclass

import numpy as np

from mouse_cli._span import Span
from mouse_cli.formats.data_files import FileFormat, reject
from mouse_cli.formats.mode_files import ModeTable, turned
from mouse_cli.formats.mode_files._survey import survey
from mouse_cli.formats.recording_files.universal_blocks import Block, blocks
from mouse_cli.model.geometry import DIRECTIONS

_NUMBER = re.compile(r"[-+]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][-+]?[0-9]+)?|[-+]?nan|[-+]?inf", re.IGNORECASE)
_COMPLEX = {55: (5,), 2414: (5, 6)}  # data types of complex values
_REAL = {55: (2,), 2414: (2, 4)}
_NORMAL, _COMPLEX_MODES = 2, (3, 7)  # analysis types
_HEAD = {55: 8, 2414: 13}  # lines before those of nodes
_POUND, _FOOT, _INCH, _G = 4.4482216152605, 0.3048, 0.0254, 9.80665
# mass units of the codes of data set 164, kg: force times s2 per length
_SLUG = _POUND / _FOOT
_MASSES = {1: 1.0, 2: _SLUG, 3: _G, 4: _SLUG, 5: 1.0, 6: _G / 1e-2, 7: _POUND / _INCH, 8: _G / 1e-3, 10: 1e3}
# their units of length, m
_METRES = {1: 1.0, 2: _FOOT, 3: 1.0, 4: _FOOT, 5: 1e-3, 6: 1e-2, 7: _INCH, 8: 1e-3, 10: 1e-3}


@dataclass(frozen=True)
class _Mode:
    """One data set: frequency, Hz; damping ratio; modal mass, 0 where it says none; value by sensor."""

    frequency_hz: float
    damping: float
    mass: float
    values: dict[str, complex]


def _read(path: str) -> ModeTable:
    with open(path, "rb") as stream:
        data = stream.read()
    mass, metre, found, first, counted = None, None, {55: [], 2414: []}, 1, 0
    for block in blocks(data):
        first, counted = first + data.count(b"\n", counted, block.at), block.at
        lines = bytes(block.content).decode("latin-1").splitlines() if block.number in (55, 2414, 164) else []
        if block.number == 164 and lines:
            units = int(lines[0][:10].strip() or 0)
            mass, metre = _MASSES.get(units), _METRES.get(units)
        elif block.number in found:
            found[block.number].append(_mode(path, first, block, lines))
    modes = [mode for mode in found[55] or found[2414] if mode is not None and mode.frequency_hz > 0]
    if not modes:
        message = "the file has no mode shapes: data sets 55 or 2414 of modes"
        reject("MD624", path, message, "export the modes as data set 55")
    modes.sort(key=lambda mode: mode.frequency_hz)
    names = [name for name in dict.fromkeys(n for mode in modes for n in mode.values) if _moves(modes, name)]
    if not names:
        reject("MD252", path, "the shapes of all modes are zero, or no numbers", "export the modes again")
    raw = np.array([[mode.values.get(name, np.nan) for mode in modes] for name in names], complex).reshape(
        len(names), -1
    )
    shapes = np.stack([turned(raw[:, r]) for r in range(len(modes))], axis=1)
    sizes = np.array([np.sqrt(mode.mass) if mode.mass > 0 else 1.0 for mode in modes])
    hz, damping = np.array([m.frequency_hz for m in modes]), np.array([m.damping for m in modes])
    return ModeTable(tuple(names), hz, damping, shapes / sizes, mass, metre=metre,
                     surveyed=survey(path, data, tuple(names)))  # fmt: skip


def _moves(modes: list[_Mode], name: str) -> bool:
    """Whether some mode moves there: programs write zeros in directions that were not measured."""
    return any(abs(mode.values.get(name, 0)) > 0 for mode in modes)


def _mode(path: str, first: int, block: Block, lines: list[str]) -> _Mode | None:
    """The mode of a data set that begins on the line `first`; None of one that is of something else."""
    number, head = block.number, _HEAD[block.number]
    if len(lines) <= head:
        _damaged(path, first, lines, len(lines) - 1, f"data set {number} is cut short in its head")
    at = 5 if number == 55 else 8
    kinds = _wholes(path, first, lines, at, 6)
    if (number == 2414 and _wholes(path, first, lines, 2, 1)[0] != 1) or kinds[1] not in (_NORMAL, *_COMPLEX_MODES):
        return None
    if kinds[4] not in (*_REAL[number], *_COMPLEX[number]) or not 1 <= kinds[5] <= 6:
        _damaged(path, first, lines, at, f"data set {number} has data type {kinds[4]} with {kinds[5]} values at a node")
    hz, damping, mass = _modal(path, first, lines, number, kinds[1])
    values = _values(path, first, lines, head, kinds[5], kinds[4] in _COMPLEX[number])
    return _Mode(hz, damping, mass, values)


def _modal(path: str, first: int, lines: list[str], number: int, analysis: int) -> tuple[float, float, float]:
    """Frequency, damping ratio and modal mass of the head."""
    row = _reals(path, first, lines, 7 if number == 55 else 11)
    if number == 55 and analysis != _NORMAL:
        return _of_pole(complex(*[*row, 0.0, 0.0][:2]))
    if number == 55:
        hz, mass, damping = (row + [0.0] * 3)[:3]
        return hz, damping or np.nan, mass
    pole = _reals(path, first, lines, 12)
    if analysis != _NORMAL and len(pole) > 1 and any(pole[:2]):
        return _of_pole(complex(*pole[:2]))
    _, hz, eigenvalue, mass, damping = (row + [0.0] * 5)[:5]
    return hz or np.sqrt(max(eigenvalue, 0.0)) / (2 * np.pi), damping or np.nan, mass


def _of_pole(pole: complex) -> tuple[float, float, float]:
    size = abs(pole)
    return size / (2 * np.pi), -pole.real / size if size else np.nan, 0.0


def _values(path: str, first: int, lines: list[str], at: int, each: int, is_complex: bool) -> dict[str, complex]:
    """The value of every node and direction."""
    found: dict[str, complex] = {}
    needed = each * (2 if is_complex else 1)
    while at < len(lines):
        if not lines[at].strip():
            at += 1
            continue
        node = _wholes(path, first, lines, at, 1)[0]
        begun, row = at, []
        while len(row) < needed:
            at += 1
            if at >= len(lines):
                _damaged(path, first, lines, begun, f"node {node} has {len(row)} values; expected {needed}")
            row += _reals(path, first, lines, at)
        numbers = np.array(row[:needed])
        for direction, value in zip(
            DIRECTIONS, numbers[0::2] + 1j * numbers[1::2] if is_complex else numbers, strict=False
        ):
            found[f"{node}{direction}"] = complex(value)
        at += 1
    return found


def _wholes(path: str, first: int, lines: list[str], at: int, count: int) -> list[int]:
    """The first `count` whole numbers of a line: in columns of ten, or parted by blanks."""
    line = lines[at]
    for words in (line.split()[:count], [line[10 * k : 10 * k + 10] for k in range(count)]):
        try:
            found = [int(word) for word in words]
        except ValueError:
            continue
        if len(found) == count:
            return found
    _damaged(path, first, lines, at, f"expected {count} whole number{'s' if count > 1 else ''} here")


def _reals(path: str, first: int, lines: list[str], at: int) -> list[float]:
    """All numbers of a line, which may touch one another."""
    line = lines[at].replace("D", "E").replace("d", "e")
    if re.sub(_NUMBER, "", line).strip():
        _damaged(path, first, lines, at, "expected numbers here")
    return [float(word) for word in _NUMBER.findall(line)]


def _damaged(path: str, first: int, lines: list[str], at: int, message: str) -> None:
    """Raise DeckError (MD252) with the line."""
    shown = lines[at][:120].rstrip() if 0 <= at < len(lines) else ""
    reject(
        "MD252", path, message, "export the modes again", Span(path, first + max(at, 0), 1, max(1, len(shown)), shown)
    )


FORMAT = FileFormat("unv", _read, ("unv", "uff", "uf", "ufb"))
