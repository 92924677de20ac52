"""Tables of modes as spreadsheets export them (.csv, .tsv, .txt): a row for each sensor or for each mode, with labels.

    node, direction, mode 1, mode 2          mode, frequency, sd,   2TY,  3TY
    frequency,     , 12.31,  47.9            1,    12.31,     0.02, 0.11, 0.52
    sd,            , 0.02,   0.1             2,    47.9,      0.1,  0.43, 0.98
    12,   TY,        0.11,   0.43

Cells are parted by commas, semicolons or tabs; beside the last two, numbers may have decimal commas. Places may be nodes, names of
sensors, or x, y, z; directions TY, -Y, or nx, ny, nz. Frequencies may stand in rows of their own, in the heads of columns
(`mode 1 (12.31 Hz)`), or in a second table of modes in the same file.
"""

import re
from dataclasses import dataclass

import numpy as np

from mouse_cli.formats.data_files import line_span, reject, text_lines
from mouse_cli.formats.mode_files import ModeFormat, ModeTable
from mouse_cli.model.geometry import DIRECTIONS

_FREQUENCY = re.compile(r"(natural )?(frequency|frequencies|freq\.?|f|fn)\s*[\[(]?\s*(hz)?\s*[\])]?", re.IGNORECASE)
_SD = re.compile(r"(sd|std|sigma|frequency[ _]sd|sd of frequency|f[ _]sd)\s*[\[(]?\s*(hz)?\s*[\])]?", re.IGNORECASE)
_DAMPING = re.compile(r"(damping( ratio)?|zeta)\s*[\[(]?\s*(%)?\s*[\])]?", re.IGNORECASE)
_MODE = re.compile(r"(?:mode|shape|phi)?[ _#]*([0-9]+)(?:\s*[\[(]?\s*([0-9.,]+)\s*hz\s*[\])]?)?", re.IGNORECASE)
_MODE_SD = re.compile(r"(?:(?:mode|shape)[ _#]*([0-9]+)[ _]*sd|sd[ _]*(?:mode|shape)?[ _#]*([0-9]+))", re.IGNORECASE)
_PLACES = {"node": "node", "point": "node", "grid": "node", "sensor": "node", "name": "node", "direction": "direction",
           "dir": "direction", "dof": "direction", "axis": "direction", "x": "x", "y": "y", "z": "z", "nx": "nx", "ny": "ny",
           "nz": "nz"}  # fmt: skip
_DIRECTION = re.compile(r"([-+]?)([TUR]?)([XYZ])([-+]?)", re.IGNORECASE)
_MISSING = ("", "-", "nan", "na", "n/a", "null")


@dataclass
class _Rows:
    """Rows of cells with the numbers of their lines, from 1; comma: numbers have decimal commas."""

    path: str
    lines: list[str]
    cells: list[tuple[int, list[str]]]
    comma: bool

    def number(self, row: int, column: int) -> float:
        """The number of a cell; NaN for one that is empty. Raises DeckError (MD252)."""
        line, cells = self.cells[row]
        word = cells[column].strip() if column < len(cells) else ""
        if word.lower() in _MISSING:
            return np.nan
        try:
            return float(word.replace(",", ".") if self.comma else word)
        except ValueError:
            message = f"'{word[:40]}' is no number"
            self.refuse(line, message, "give numbers, and nothing where none was measured", word)

    def refuse(self, line: int, message: str, help: str, part: str = "") -> None:
        """Raise DeckError (MD252) with the line."""
        reject("MD252", self.path, message, help, line_span(self.path, line, self.lines[line - 1], part))


def _read(path: str) -> ModeTable:
    rows = _cells(path)
    heads = [i for i, (_, cells) in enumerate(rows.cells) if _is_head(cells)]
    if not heads:
        line = rows.cells[0][0] if rows.cells else 1
        rows.lines = rows.lines or [""]
        rows.refuse(line, "the table has no head that names its columns", "begin with `node, direction, mode 1, ...`")
    found: dict[str, ModeTable] = {}
    for head, end in zip(heads, [*heads[1:], len(rows.cells)], strict=True):
        by_mode = _word(rows.cells[head][1][0]) in ("mode", "modes", "no", "no.")
        table = _of_modes(rows, head, end) if by_mode else _of_sensors(rows, head, end)
        found["modes" if by_mode and not table.names else "shapes"] = table
    return _joined(rows, found)


def _joined(rows: _Rows, found: dict[str, ModeTable]) -> ModeTable:
    """Shapes, with the frequencies of a table of modes where there is one; in ascending order of frequency."""
    shapes, modes = found.get("shapes"), found.get("modes")
    table = shapes or modes
    if shapes is not None and modes is not None:
        if len(modes.frequency_hz) != len(shapes.frequency_hz):
            counts = f"{len(modes.frequency_hz)} frequencies and shapes of {len(shapes.frequency_hz)} modes"
            rows.refuse(rows.cells[0][0], f"the tables have {counts}", "give one row for each mode")
        table = ModeTable(shapes.names, modes.frequency_hz, modes.damping, shapes.shapes, None, modes.frequency_sd_hz,
                          shapes.shape_sd, shapes.places, shapes.directions)  # fmt: skip
    if np.isnan(table.frequency_hz).all() and not table.names:
        rows.refuse(rows.cells[0][0], "the table has neither frequencies nor shapes", "give a row `frequency`")
    return table.ascending()


def _cells(path: str) -> _Rows:
    lines = text_lines(path)
    kept = [
        (i, line) for i, line in enumerate(lines, 1) if line.strip().strip(",;\t") and not line.lstrip().startswith("#")
    ]
    text = "".join(line for _, line in kept)
    mark = ";" if ";" in text else "\t" if "\t" in text else ","
    split = [
        (
            i,
            [
                cell.strip().strip('"')
                for cell in line.removeprefix("\xef\xbb\xbf").removeprefix("\ufeff").rstrip("\r\n").split(mark)
            ],
        )
        for i, line in kept
    ]
    return _Rows(path, lines, split, mark != "," and "," in text)


def _word(cell: str) -> str:
    return cell.strip().lower()


def _is_head(cells: list[str]) -> bool:
    """Whether a row names columns: places, or modes with their frequencies."""
    first = _word(cells[0])
    if first in ("mode", "modes", "no", "no."):
        return any(_FREQUENCY.fullmatch(cell) for cell in cells[1:])
    return first in _PLACES and any(_MODE.fullmatch(cell) or _MODE_SD.fullmatch(cell) for cell in cells[1:])


def _of_modes(rows: _Rows, head: int, end: int) -> ModeTable:
    """A row for each mode; columns that are neither frequency nor sd nor damping are sensors, by their names."""
    names = rows.cells[head][1]
    kinds = [
        next((k for k, form in (("f", _FREQUENCY), ("sd", _SD), ("zeta", _DAMPING)) if form.fullmatch(n)), "")
        for n in names
    ]
    body = range(head + 1, end)
    take = lambda kind: np.array([rows.number(i, kinds.index(kind)) if kind in kinds else np.nan for i in body])
    sensors = [c for c in range(1, len(names)) if not kinds[c] and names[c]]
    shapes = np.array([[rows.number(i, c) for i in body] for c in sensors]).reshape(len(sensors), len(body))
    percent = "zeta" in kinds and "%" in names[kinds.index("zeta")]
    named, signs = zip(*(_named(names[c]) for c in sensors), strict=True) if sensors else ((), ())
    shapes = shapes * np.array(signs).reshape(-1, 1)
    damping, sd = take("zeta") / (100 if percent else 1), take("sd") if "sd" in kinds else None
    return ModeTable(tuple(named), take("f"), damping, shapes, frequency_sd_hz=sd)


def _named(text: str) -> tuple[str, float]:
    """Name of a sensor as decks write it, and its sign: `12:-Y` is -12TY."""
    found = re.fullmatch(r"([0-9]+)[ :_.]*([-+]?[TUR]?[XYZ][-+]?)", text.strip(), re.IGNORECASE)
    if not found:
        return text.strip(), 1.0
    direction, sign = _direction(found[2])
    return f"{found[1]}{direction}", sign


def _direction(text: str) -> tuple[str, float]:
    """TY and the sign, of `Y`, `-UY`, `TY-`; empty where it is none."""
    found = _DIRECTION.fullmatch(text.strip())
    if not found:
        return "", 1.0
    name = ("R" if found[2].upper() == "R" else "T") + found[3].upper()
    return name, -1.0 if "-" in (found[1], found[4]) else 1.0


def _of_sensors(rows: _Rows, head: int, end: int) -> ModeTable:
    """A row for each sensor; rows that begin with frequency, sd or damping hold these of the modes, above the head too."""
    names = rows.cells[head][1]
    columns = [c for c, n in enumerate(names) if _word(n) not in _PLACES and _MODE.fullmatch(n)]
    sds = {int(m[1] or m[2]): c for c, n in enumerate(names) if (m := _MODE_SD.fullmatch(n))}
    hz = np.array([float((_MODE.fullmatch(names[c])[2] or "nan").replace(",", ".")) for c in columns])
    sd, damping, body = None, np.full(len(columns), np.nan), []
    for i in (*range(head if head and not _is_head(rows.cells[0][1]) else 0), *range(head + 1, end)):
        first = rows.cells[i][1][0]
        values = (
            [rows.number(i, c) for c in columns] if any(f.fullmatch(first) for f in (_FREQUENCY, _SD, _DAMPING)) else []
        )
        if values and _FREQUENCY.fullmatch(first):
            hz = np.array(values)
        elif values and _SD.fullmatch(first):
            sd = np.array(values)
        elif values:
            damping = np.array(values) / (100 if "%" in first else 1)
        elif i > head:
            body.append(i)
    places = {_PLACES[_word(n)]: c for c, n in enumerate(names) if _word(n) in _PLACES}
    read = [_place(rows, i, places) for i in body]
    signs = np.array([sign for _, sign, _, _ in read]).reshape(-1, 1)
    shapes = signs * np.array([[rows.number(i, c) for c in columns] for i in body]).reshape(len(body), len(columns))
    numbers = [int(_MODE.fullmatch(names[c])[1]) for c in columns]
    shape_sd = (
        np.array([[rows.number(i, sds[n]) for n in numbers] for i in body])
        if sds and set(numbers) <= set(sds)
        else None
    )
    at = {name: where for name, _, where, _ in read if where is not None}
    along = {name: vector for name, _, _, vector in read if vector is not None}
    return ModeTable(tuple(name for name, *_ in read), hz, damping, shapes, None, sd, shape_sd, at, along)


def _place(rows: _Rows, i: int, places: dict[str, int]) -> tuple[str, float, tuple | int | None, tuple | None]:
    """Name, sign, coordinates or node, and direction (6) of the sensor of a row; the latter two where they are given by numbers."""
    line, cells = rows.cells[i]
    cell = lambda key: cells[places[key]].strip() if key in places and places[key] < len(cells) else ""
    vector, sign, direction = None, 1.0, ""
    if {"nx", "ny", "nz"} <= set(places):
        numbers = np.array([rows.number(i, places[key]) for key in ("nx", "ny", "nz")])
        if not 0 < np.linalg.norm(numbers) < np.inf:
            rows.refuse(line, "the direction of the sensor is no vector", "give nx, ny and nz, not all 0")
        vector = (*(numbers / np.linalg.norm(numbers)), 0.0, 0.0, 0.0)
    elif "direction" in places:
        direction, sign = _direction(cell("direction"))
        if not direction:
            rows.refuse(
                line, f"'{cell('direction')[:40]}' is no direction", "give TX, -Y, RZ or the like", cell("direction")
            )
    at = None
    if {"x", "y"} <= set(places):
        at = tuple(rows.number(i, places[key]) if key in places else 0.0 for key in "xyz")
        vector = vector or (tuple(np.eye(6)[DIRECTIONS.index(direction)]) if direction else None)
        if vector is None or not np.isfinite(at).all():
            message = "a sensor by coordinates needs x, y, z and a direction"
            rows.refuse(line, message, "give x, y, z and direction, or nx, ny, nz")
    named = cell("node") or f"row {line}"
    if vector is not None and at is None:  # on a node of the model, in a direction of its own
        if not named.isdecimal():
            rows.refuse(line, f"'{named[:40]}' is no node", "give the number of the node, or x, y and z", named)
        return f"{named} along {', '.join(f'{v:g}' for v in vector[:3])}", sign, int(named), vector
    name, own = (f"{named}{direction}", 1.0) if direction else _named(named)
    return name, sign * own, at, vector


FORMAT = ModeFormat("csv", _read, ("csv", "tsv", "txt"))
