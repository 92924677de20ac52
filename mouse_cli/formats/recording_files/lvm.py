"""Measurement files of LabVIEW (.lvm, also under the suffixes of text): a head, and segments each with a head of its own.

After National Instruments, Specification for the LabVIEW Measurement File (.lvm), 2020. Segments of the same channels follow one
another in each column, and so do their times in `X_Value`; where time does not go on from one to the next begins a new stretch.
A file may be written without heads: its first line then names the columns.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from mouse_cli.formats.data_files import FileFormat, check_memory, line_span, reject, text_lines
from mouse_cli.formats.recording_files import MOST_COLUMNS, Column, Contents

_MARK, _END, _X, _COMMENT = "LabVIEW Measurement", "***End_of_Header***", "X_Value", "Comment"
_HEADLESS = "no head of a segment and no row of its channels, X_Value"
_GOES_ON = 0.5  # of a step that two segments of one record may be apart more or less than one


@dataclass(frozen=True)
class _Style:
    """How the file is written: what stands between cells, and the decimal point."""

    separator: str
    point: str

    def cells(self, line: str) -> list[str]:
        return [cell.strip() for cell in line.split(self.separator, 2 * MOST_COLUMNS + 2)]

    def number(self, cell: str) -> float:
        """Raises ValueError."""
        return float(cell.replace(self.point, "."))


@dataclass(frozen=True)
class _Segment:
    """names, units, steps (s, None where the head is silent) and values (k,) by channel; x (k,): what runs along the rows.

    timed: whether that is time.
    """

    names: tuple[str, ...]
    units: tuple[str, ...]
    steps: tuple[float | None, ...]
    values: tuple[np.ndarray, ...]
    x: np.ndarray
    timed: bool


def _read(path: str) -> Contents:
    lines = text_lines(path, "utf-8-sig", "replace")
    style, bare = _style(lines[:200]), lines[0].startswith(_X)
    if not (bare or lines[0].startswith(_MARK)):
        reject("MD252", path, f"the first line is neither '{_MARK}' nor '{_X}'", "give the file as LabVIEW writes it")
    spans = [(0, 0, len(lines))] if bare else _spans(path, style, lines)
    segments = [_segment(path, style, lines, *span) for span in spans]
    first = segments[0]
    same = [
        each for each in segments if (each.names, each.units, each.timed) == (first.names, first.units, first.timed)
    ]
    passed = (
        ()
        if len(same) == len(segments)
        else (f"{len(segments) - len(same)} segments have other channels than the first",)
    )
    x = Column(
        _X if first.timed else "frequency", np.concatenate([each.x for each in same]), "s" if first.timed else "Hz"
    )
    joined = [np.concatenate([each.values[j] for each in same]) for j in range(len(first.names))]
    columns = [
        Column(name, values, unit, step if first.timed else None)
        for name, values, unit, step in zip(first.names, joined, first.units, first.steps, strict=True)
    ]
    return Contents((x, *columns) if len(x.values) else tuple(columns), remarks=passed, stretches=_stretches(same))


def _style(lines: list[str]) -> _Style:
    """By the lines `Separator` and `Decimal_Separator` of the head; where it has none, a tabulator, and what numbers have."""
    separator = next((line[9] for line in lines if line.startswith("Separator") and len(line) > 9), "\t")
    usual = "," if separator != "," and "," in "".join(lines[1:3]) and "." not in "".join(lines[1:3]) else "."
    point = next((line[18] for line in lines if line.startswith("Decimal_Separator") and len(line) > 18), usual)
    return _Style(separator, point)


def _spans(path: str, style: _Style, lines: list[str]) -> Iterator[tuple[int, int, int]]:
    """Of each segment its first line, that of its names, and the one after its last, from 0."""
    ends = [i for i, line in enumerate(lines) if line.startswith(_END)]
    heads = [i + 1 for i in ends if i + 1 < len(lines) and style.cells(lines[i + 1])[0] == _X]
    if not heads:
        reject("MD252", path, f"the file has {_HEADLESS}", "the file is cut short, or damaged: write it again")
    first = ends[0] + 1 if ends[0] + 1 != heads[0] else 0
    for head, following in zip(heads, [*heads[1:], len(lines)], strict=True):
        last = next((i for i in range(head + 1, following) if lines[i].startswith("Channels")), following)
        yield first, head, last
        first = last


def _segment(path: str, style: _Style, lines: list[str], first: int, head: int, last: int) -> _Segment:
    titles = style.cells(lines[head])
    wide = len(titles) - 1 if titles[-1] == _COMMENT else len(titles)
    while wide > 1 and not titles[wide - 1]:
        wide -= 1
    at = [j for j in range(wide) if titles[j] != _X]
    if not at:
        reject(
            "MD252", path, "the segment has no channel", "write the file again", line_span(path, head + 1, lines[head])
        )
    if len(at) > MOST_COLUMNS:
        reject("MD258", path, f"the segment has more than {MOST_COLUMNS} channels", "divide it")
    keys = {cells[0]: cells[1:] for cells in map(style.cells, lines[first:head]) if len(cells) > 1}
    said = lambda key: [keys[key][j - 1] if 0 < j <= len(keys.get(key, ())) else "" for j in at]
    counts = [int(value) if value.isdecimal() else None for value in said("Samples")]
    table = _table(path, style, lines, head, last, wide)
    values = tuple(_cut(path, titles[j], table[:, j], count, head) for j, count in zip(at, counts, strict=True))
    steps = tuple(_positive(style, value) for value in said("Delta_X"))
    longest = max(len(each) for each in values)
    x = table[:longest, 0]
    if np.isnan(x).all() and steps[0]:
        x = (_finite(style, said("X0")[0]) or 0.0) + steps[0] * np.arange(longest)
    timed = said("X_Dimension")[0].lower() in ("", "time")
    units = tuple(said("Y_Unit_Label"))
    names = tuple(titles[j] or str(k) for k, j in enumerate(at, 1))
    return _Segment(names, units, steps, values, x if not np.isnan(x).all() else np.zeros(0), timed)


def _finite(style: _Style, cell: str) -> float | None:
    try:
        value = style.number(cell)
    except ValueError:
        return None
    return value if np.isfinite(value) else None


def _positive(style: _Style, cell: str) -> float | None:
    value = _finite(style, cell)
    return value if value is not None and value > 0 else None


def _table(path: str, style: _Style, lines: list[str], head: int, last: int, wide: int) -> np.ndarray:
    """The rows below line `head` (k, wide), without their comments; NaN for an empty cell; refuses what is no number."""
    rows = [i for i in range(head + 1, last) if lines[i].strip()]
    if not rows:
        reject(
            "MD252",
            path,
            "the segment has no row of numbers",
            "the file is cut short",
            line_span(path, head + 1, lines[head]),
        )
    check_memory(path, 16 * len(rows) * wide, "the table of numbers")
    table = np.full((len(rows), wide), np.nan)
    first = 0 if style.cells(lines[rows[0]])[0] else 1
    try:
        plain = (lines[i].replace(style.point, ".") for i in rows)
        table[:, first:] = np.loadtxt(
            plain, delimiter=style.separator, usecols=range(first, wide), ndmin=2, comments=None
        )
    except ValueError:
        _cell_by_cell(path, style, lines, rows, table)
    return table


def _cell_by_cell(path: str, style: _Style, lines: list[str], rows: list[int], table: np.ndarray) -> None:
    for k, i in enumerate(rows):
        for j, cell in enumerate(style.cells(lines[i])[: table.shape[1]]):
            try:
                table[k, j] = style.number(cell) if cell else np.nan
            except ValueError:
                message = f"'{cell[:40]}' is no number"
                reject("MD252", path, message, "the file is damaged here", line_span(path, i + 1, lines[i], cell))


def _cut(path: str, name: str, values: np.ndarray, count: int | None, head: int) -> np.ndarray:
    """The samples of a channel that its head promises, all where it is silent or rows were appended to it later."""
    if count is None:
        return values
    held = int(np.flatnonzero(~np.isnan(values))[-1]) + 1 if not np.isnan(values).all() else 0
    if held < count:
        message = f"channel '{name[:40]}' has {held} samples; the head of its segment, above line {head + 1}, promises {count}"
        reject("MD252", path, message, "the file is cut short: copy it again", line_span(path, head + 1, name))
    return values[:held]


def _stretches(segments: list[_Segment]) -> tuple[tuple[int, int], ...]:
    """First sample and the one after the last of what was recorded without a break; none where all of it was."""
    ends = np.cumsum([len(each.values[0]) for each in segments]).tolist()
    breaks = [end for end, (one, two) in zip(ends, pairwise(segments), strict=False) if not _goes_on(one, two)]
    return tuple(pairwise([0, *breaks, ends[-1]])) if breaks else ()


def _goes_on(one: _Segment, two: _Segment) -> bool:
    if not (len(one.x) and len(two.x)):
        return True
    step = one.steps[0] or (one.x[-1] - one.x[0]) / max(len(one.x) - 1, 1)
    return bool(abs(two.x[0] - one.x[-1] - step) <= _GOES_ON * step)


FORMAT = FileFormat(
    "lvm",
    _read,
    ("lvm", "txt", "csv", "dat", "asc"),
    lambda head: head.removeprefix(b"\xef\xbb\xbf").startswith((_MARK.encode(), f"{_X}\t".encode())),
)
