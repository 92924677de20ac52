"""Tables of modes as spreadsheets export them (.csv, .tsv, .txt): a row for each sensor or for each mode, with labels.

    node, direction, mode 1, mode 2          mode, frequency, sd,   2TY,  3TY
    frequency,     , 12.31,  47.9            1,    12.31,     0.02, 0.11, 0.52
    sd,            , 0.02,   0.1             2,    47.9,      0.1,  0.43, 0.98
    12,   TY,        0.11,   0.43

Cells are parted by commas, semicolons or tabs; beside the last two, and in quotes, numbers may have decimal commas. Places may be
nodes, names of sensors, or x, y, z; directions TY, -Y, 2, or nx, ny, nz. Frequencies may stand in rows of their own, in the heads
of columns (`mode 1 (12.31 Hz)`), or in a second table of modes in the same file. A mode may have two columns: real and imag, or
amplitude and phase.
"""

import re

import numpy as np

from mouse_cli.formats.data_files import FileFormat
from mouse_cli.formats.mode_files import ModeTable, turned
from mouse_cli.formats.mode_files._cells import Rows, missing, numeric, rows_of
from mouse_cli.formats.mode_files._labels import ModeLabel, in_hz, mode_label, ratio, sd_in_hz, sd_of_mode, value_label
from mouse_cli.model.geometry import DIRECTIONS

_PLACES = {"node": "node", "point": "node", "grid": "node", "sensor": "node", "name": "node", "direction": "direction",
           "dir": "direction", "dof": "direction", "axis": "direction", "x": "x", "y": "y", "z": "z", "nx": "nx", "ny": "ny",
           "nz": "nz"}  # fmt: skip
_MODES = ("mode", "modes", "no", "no.")
_DIRECTION = re.compile(r"([-+]?)([TUR]?)([XYZ])([-+]?)", re.IGNORECASE)
_NUMBERED = re.compile(r"([-+]?)([1-6])")
_BEGIN = "begin with `node, direction, mode 1, ...` or `mode, frequency, 2TY, ...`"
_ROUNDED = 0.02  # relative: to which a frequency in a head may be rounded
_RAD = 7.0  # a phase beyond it, in absolute value, is in degrees


def _read(path: str) -> ModeTable:
    rows = rows_of(path)
    heads = [i for i, (_, cells) in enumerate(rows.cells) if _is_head(cells)]
    if not heads:
        rows.cells = rows.cells or [(1, [""])]
        what = "the table has no head that names its columns"
        rows.refuse(0, f"{what}, and no separator" if len(rows.cells[0][1]) == 1 else what, _BEGIN)
    found: dict[str, ModeTable] = {}
    for head, end in zip(heads, [*heads[1:], len(rows.cells)], strict=True):
        by_mode = rows.cell(head, 0).lower() in _MODES
        table = _of_modes(rows, head, end) if by_mode else _of_sensors(rows, head, end)
        found["modes" if by_mode and not table.names else "shapes"] = table
    return _joined(rows, found)


def _joined(rows: Rows, found: dict[str, ModeTable]) -> ModeTable:
    """Shapes, with the frequencies of a table of modes where there is one; in ascending order of frequency."""
    shapes, modes = found.get("shapes"), found.get("modes")
    table = shapes or modes
    if shapes is not None and modes is not None:
        if len(modes.frequency_hz) != len(shapes.frequency_hz):
            counts = f"{len(modes.frequency_hz)} frequencies and shapes of {len(shapes.frequency_hz)} modes"
            rows.refuse(0, f"the tables have {counts}", "give one row for each mode")
        table = ModeTable(shapes.names, modes.frequency_hz, modes.damping, shapes.shapes, None, modes.frequency_sd_hz,
                          shapes.shape_sd, shapes.places, shapes.directions)  # fmt: skip
    if np.isnan(table.frequency_hz).all() and not table.names:
        rows.refuse(0, "the table has neither frequencies nor shapes", "give a row `frequency`")
    return table.ascending()


def _is_head(cells: list[str]) -> bool:
    """Whether a row names columns: places, or modes with their frequencies."""
    first = cells[0].lower()
    if first in _MODES:
        return any((label := value_label(cell)) and label.kind == "frequency" for cell in cells[1:])
    return first in _PLACES and any(mode_label(cell) or sd_of_mode(cell) for cell in cells[1:])


def _units(rows: Rows, head: int, end: int, places: int) -> list[str]:
    """The row below the head that names units, where there is one: of words alone, and none in the first `places` cells."""
    cells = rows.cells[head + 1][1] if head + 1 < end else []
    named = [cell for cell in cells[places:] if not missing(cell)]
    empty = all(missing(cell) or re.fullmatch(r"[\[(].*[\])]", cell) for cell in cells[:places])
    return cells if named and empty and not any(map(numeric, named)) else []


def _of_modes(rows: Rows, head: int, end: int) -> ModeTable:
    """A row for each mode; columns that are neither frequency nor sd nor damping are sensors, by their names."""
    names, units = rows.cells[head][1], _units(rows, head, end, 1)
    body = range(head + 2 if units else head + 1, end)
    with_units = [f"{n} [{u.strip('[]()')}]" for n, u in zip(names, [*units, *[""] * len(names)], strict=False)]
    labels = [value_label(a) or value_label(b) for a, b in zip(with_units, names, strict=True)]
    at = {label.kind: c for c, label in enumerate(labels) if label}
    for i in body:
        rows.fitting(i, head)
    take = lambda kind: np.array([rows.number(i, at[kind]) if kind in at else np.nan for i in body])
    sensors = [c for c in range(1, len(names)) if not labels[c] and names[c]]
    shapes = np.array([[rows.value(i, c) for i in body] for c in sensors]).reshape(len(sensors), len(body))
    named, signs = zip(*(_named(names[c]) for c in sensors), strict=True) if sensors else ((), ())
    unit = labels[at["frequency"]].unit
    hz, sd = in_hz(take("frequency"), unit), None
    if "sd" in at:
        sd = sd_in_hz(take("sd"), labels[at["sd"]].unit, hz, unit)
    damping = ratio(take("damping"), labels[at["damping"]]) if "damping" in at else take("damping")
    shapes = _real(shapes) * np.array(signs).reshape(-1, 1)
    return ModeTable(tuple(named), hz, damping, shapes, frequency_sd_hz=sd)


def _named(text: str) -> tuple[str, float]:
    """Name of a sensor as decks write it, and its sign: `12:-Y` is -12TY."""
    found = re.fullmatch(r"([0-9]+)[ :_.]*([-+]?[TUR]?[XYZ][-+]?)", text.strip(), re.IGNORECASE)
    if not found:
        return text.strip(), 1.0
    direction, sign = _direction(found[2])
    return f"{found[1]}{direction}", sign


def _direction(text: str) -> tuple[str, float]:
    """TY and the sign, of `Y`, `-UY`, `TY-`, `2`; empty where it is none."""
    text = text.strip()
    if numbered := _NUMBERED.fullmatch(text):
        return DIRECTIONS[int(numbered[2]) - 1], -1.0 if numbered[1] == "-" else 1.0
    found = _DIRECTION.fullmatch(text)
    if not found:
        return "", 1.0
    name = ("R" if found[2].upper() == "R" else "T") + found[3].upper()
    return name, -1.0 if "-" in (found[1], found[4]) else 1.0


def _of_sensors(rows: Rows, head: int, end: int) -> ModeTable:
    """A row for each sensor; rows that begin with frequency, sd or damping hold these of the modes, above the head too."""
    names = rows.cells[head][1]
    labels = {c: label for c, n in enumerate(names) if n.lower() not in _PLACES and (label := mode_label(n))}
    modes = _by_mode(rows, head, labels)
    first = [min(parts.values()) for parts in modes]  # the column of a mode that holds its frequency, sd and damping
    places = {_PLACES[n.lower()]: c for c, n in enumerate(names) if n.lower() in _PLACES}
    units = _units(rows, head, end, min(labels, default=0))
    taken = {"frequency": (None, np.array([labels[c].hz for c in first]))}
    above = range(head) if head and not _is_head(rows.cells[0][1]) else ()
    body = []
    for i in (*above, *range(head + 2 if units else head + 1, end)):
        label = value_label(rows.cell(i, 0))
        if label or i > head:
            rows.fitting(i, head)
        if label:
            taken[label.kind] = label, np.array([rows.number(i, c) for c in first])
        elif i > head:
            body.append(i)
    _agreed(rows, head, labels, first, taken)
    read = [_place(rows, i, places) for i in body]
    _once(rows, body, [name for name, *_ in read])
    signs = np.array([sign for _, sign, _, _ in read]).reshape(-1, 1)
    columns = [_shape(rows, body, parts, labels) for parts in modes]
    shapes = np.array(columns).T.reshape(len(body), len(modes))
    at = {name: where for name, _, where, _ in read if where is not None}
    along = {name: vector for name, _, _, vector in read if vector is not None}
    shape_sd = _shape_sd(rows, body, names, [labels[c].number for c in first])
    return ModeTable(tuple(name for name, *_ in read), *_values(taken, len(modes)), signs * _real(shapes), None,
                     _sd(taken), shape_sd, at, along)  # fmt: skip


def _by_mode(rows: Rows, head: int, labels: dict[int, ModeLabel]) -> list[dict[str, int]]:
    """The columns of each mode by their part. Raises DeckError (MD252) where a part is given twice, or alone is none."""
    found: dict[object, dict[str, int]] = {}
    for c, label in labels.items():
        own = found.setdefault(label.number or (c, label.hz), {})
        if label.part in own:
            name = rows.cell(head, c)
            rows.refuse(head, f"two columns are of mode {label.number}", "give each mode a number of its own", name)
        own[label.part] = c
    for own in found.values():
        if set(own) not in ({"real"}, {"real", "imag"}, {"size", "phase"}):
            c = next(iter(own.values()))
            message = f"'{rows.cell(head, c)[:40]}' is only a part of a shape"
            help = "give real and imag, or amplitude and phase, of each mode: amplitudes alone have no signs"
            rows.refuse(head, message, help, rows.cell(head, c))
    return list(found.values())


def _shape(rows: Rows, body: list[int], parts: dict[str, int], labels: dict[int, ModeLabel]) -> np.ndarray:
    """The shape of a mode (s,) of its columns, complex where it has two."""
    if "size" not in parts:
        real = np.array([rows.value(i, parts["real"]) for i in body])
        return real + 1j * np.array([rows.number(i, parts["imag"]) for i in body]) if "imag" in parts else real
    size, phase = (np.array([rows.number(i, parts[key]) for i in body]) for key in ("size", "phase"))
    degrees = labels[parts["phase"]].degrees
    if degrees is None and np.nanmax(np.abs(phase), initial=0.0) > _RAD:
        degrees = True
    if degrees is None and np.nanmax(np.abs(phase), initial=0.0) > 0:
        row, name = (
            next(i for i, n in enumerate(rows.cells) if n[0] < rows.cells[body[0]][0] and _is_head(n[1])),
            parts["phase"],
        )
        help = "write `phase [deg]` or `phase [rad]`"
        rows.refuse(row, "the phase may be in degrees or in radians", help, rows.cell(row, name))
    return size * np.exp(1j * (np.deg2rad(phase) if degrees else phase))


def _real(shapes: np.ndarray) -> np.ndarray:
    """Shapes (s, m), complex ones turned so that their real parts are largest."""
    columns = [turned(shapes[:, r]) for r in range(shapes.shape[1])]
    return np.stack(columns, axis=1) if columns else shapes.real


def _agreed(rows: Rows, head: int, labels: dict[int, ModeLabel], first: list[int], taken: dict) -> None:
    """Refuse frequencies in a row that are others than those in the heads."""
    row = _values(taken, len(first))[0]
    for c, hz in zip(first, row, strict=True):
        if abs(labels[c].hz - hz) > _ROUNDED * abs(hz):
            message = f"'{rows.cell(head, c)[:40]}' stands above a frequency of {hz:.6g} Hz"
            rows.refuse(head, message, "give the frequencies once", rows.cell(head, c))


def _values(taken: dict, m: int) -> tuple[np.ndarray, np.ndarray]:
    """Frequencies in Hz and damping ratios (m,)."""
    label, hz = taken["frequency"]
    damping = ratio(taken["damping"][1], taken["damping"][0]) if "damping" in taken else np.full(m, np.nan)
    return in_hz(hz, label.unit if label else ""), damping


def _sd(taken: dict) -> np.ndarray | None:
    if "sd" not in taken:
        return None
    (own, hz), (label, sd) = taken["frequency"], taken["sd"]
    unit = own.unit if own else ""
    return sd_in_hz(sd, label.unit, in_hz(hz, unit), unit)


def _shape_sd(rows: Rows, body: list[int], names: list[str], numbers: list[int]) -> np.ndarray | None:
    """Of the columns of standard deviations, where every mode has one."""
    sds = {number: c for c, n in enumerate(names) if (number := sd_of_mode(n))}
    if not sds or not set(numbers) <= set(sds):
        return None
    return np.array([[rows.number(i, sds[n]) for n in numbers] for i in body])


def _once(rows: Rows, body: list[int], names: list[str]) -> None:
    """Refuse a sensor that has two rows, by both their lines."""
    seen: dict[str, int] = {}
    for i, name in zip(body, names, strict=True):
        if name in seen:
            message = f"sensor {name[:40]} has a row already, on line {rows.cells[seen[name]][0]}"
            rows.refuse(i, message, "give each sensor once, or mend its node or direction")
        seen[name] = i


def _place(rows: Rows, i: int, places: dict[str, int]) -> tuple[str, float, tuple | int | None, tuple | None]:
    """Name, sign, coordinates or node, and direction (6) of the sensor of a row; the latter two where they are given by numbers."""
    cell = lambda key: rows.cell(i, places[key]) if key in places else ""
    vector, sign, direction = None, 1.0, ""
    if {"nx", "ny", "nz"} <= set(places):
        numbers = np.array([rows.number(i, places[key]) for key in ("nx", "ny", "nz")])
        if not 0 < np.linalg.norm(numbers) < np.inf:
            rows.refuse(i, "the direction of the sensor is no vector", "give nx, ny and nz, not all 0")
        vector = (*(numbers / np.linalg.norm(numbers)), 0.0, 0.0, 0.0)
    elif "direction" in places:
        direction, sign = _checked(rows, i, cell("node"), cell("direction"))
    at = None
    if {"x", "y"} <= set(places):
        at = tuple(rows.number(i, places[key]) if key in places else 0.0 for key in "xyz")
        vector = vector or (tuple(np.eye(6)[DIRECTIONS.index(direction)]) if direction else None)
        if vector is None or not np.isfinite(at).all():
            message = "a sensor by coordinates needs x, y, z and a direction"
            rows.refuse(i, message, "give x, y, z and direction, or nx, ny, nz")
    named = cell("node") or f"row {rows.cells[i][0]}"
    if vector is not None and at is None:  # on a node of the model, in a direction of its own
        if not named.isdecimal():
            rows.refuse(i, f"'{named[:40]}' is no node", "give the number of the node, or x, y and z", named)
        return f"{named} along {', '.join(f'{v:g}' for v in vector[:3])}", sign, int(named), vector
    name, own = (f"{named}{direction}", 1.0) if direction else _named(named)
    return name, sign * own, at, vector


def _checked(rows: Rows, i: int, node: str, text: str) -> tuple[str, float]:
    """The direction of a row and its sign. Raises DeckError (MD252) where it is none."""
    direction, sign = _direction(text)
    if node and not node.isdecimal() and _direction(node)[0] and text.isdecimal():
        rows.refuse(i, f"'{node}' is a direction and '{text}' a node", "exchange the heads of the two columns", node)
    if not direction and node and missing(text):
        message = f"'{node[:40]}' has no direction, and is neither frequency, sd nor damping"
        rows.refuse(i, message, "give the sensor a direction, or delete the row", node)
    if not direction:
        rows.refuse(i, f"'{text[:40]}' is no direction", "give TX, -Y, RZ, 1 to 6 or the like", text)
    return direction, sign


FORMAT = FileFormat("csv", _read, ("csv", "tsv", "txt"))
