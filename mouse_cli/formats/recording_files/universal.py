"""Universal files (.uff, .unv, .uf, .ufb): time histories and frequency response functions of data sets 58 and 58b, units of 164.

Own code rather than pyuff, which gives up on files that instruments write: a line end before binary numbers, numbers that touch
one another, blanks up to column 80, text in national letters.
"""

import numpy as np

from mouse_cli.formats.data_files import FileFormat
from mouse_cli.formats.recording_files import Column, Contents, Function
from mouse_cli.formats.recording_files.universal_blocks import blocks, lines
from mouse_cli.formats.recording_files.universal_functions import Axis, NodalFunction, nodal_function
from mouse_cli.model.channel_units import unit

_SYSTEMS = {1: ("m", "N"), 2: ("ft", "lbf"), 3: ("m", "kgf"), 5: ("mm", "mN"), 7: ("in", "lbf"), 10: ("mm", "N")}
_KINDS = {8: "receptance", 11: "mobility", 12: "accelerance"}
_LABELS = {8: "{length}", 11: "{length}/s", 12: "{length}/s2", 9: "{force}", 13: "{force}"}
_TIME, _FRF, _COHERENCE = 1, 4, 6
_TIMES, _FREQUENCIES = 17, 18
_COMMON = 1e-6  # of a step, by which lines that are one may differ


def _read(path: str) -> Contents:
    with open(path, "rb") as stream:
        data = stream.read()
    system: tuple[str, str] | None = None
    columns: list[Column] = []
    functions: list[NodalFunction] = []
    coherences: dict[tuple[str, str], NodalFunction] = {}
    passed: dict[str, int] = {}
    found = 0
    for block in blocks(data):
        found += 1
        if block.number == 164:
            code = lines(block.content, 0, 1)[0][0][:10].strip()
            system = _SYSTEMS.get(int(code) if code.isdecimal() else 0)
        if block.number != 58:
            continue
        each = nodal_function(block)
        if each.type == _TIME or (
            each.type == 0 and not np.iscomplexobj(each.y) and each.abscissa.kind != _FREQUENCIES
        ):
            columns.append(Column(_name(each), each.y, _unit(each.ordinate, system, each.output), each.step))
        elif each.type == _FRF:
            functions.append(each)
        elif each.type == _COHERENCE:
            coherences[each.output, each.reference] = each
        else:
            passed[f"functions of type {each.type}"] = passed.get(f"functions of type {each.type}", 0) + 1
    if not found:
        raise ValueError("no data set between lines of -1")
    known = tuple(_function(each, coherences, system) for each in functions)
    return Contents(tuple(columns), None, known, tuple(f"{count} {what} passed over" for what, count in passed.items()))


def _name(each: NodalFunction) -> str:
    """A time history by its sensor; by the first line of its head where it has none."""
    return each.name if each.output == "0" and each.name and each.name.upper() != "NONE" else each.output


def _unit(axis: Axis, system: tuple[str, str] | None, sensor: str = "") -> str:
    """The label of the axis, if it is a unit that is known or there is nothing better, else that of the units of the file."""
    label = _LABELS.get(axis.kind)
    if unit(axis.unit) is not None or system is None or label is None or "R" in sensor:
        return axis.unit
    return label.format(length=system[0], force=system[1])


def _function(
    each: NodalFunction, coherences: dict[tuple[str, str], NodalFunction], system: tuple[str, str] | None
) -> Function:
    above, below = _unit(each.ordinate, system, each.output), _unit(each.denominator, system, each.reference)
    label = f"({above})/{below}" if unit(above) and unit(below) else above if "/" in above and not below else ""
    coherence = coherences.get((each.output, each.reference))
    if coherence is not None and (
        len(coherence.x) != len(each.x) or np.abs(coherence.x - each.x).max() > _COMMON * max(each.x.max(), 1e-300)
    ):
        coherence = None
    kind = _KINDS.get(each.ordinate.kind, "")
    return Function(
        each.output, each.reference, each.x, each.y.astype(complex), kind, label,
        coherence=None if coherence is None else np.clip(coherence.y.real, 0.0, 1.0),
    )  # fmt: skip


FORMAT = FileFormat("unv", _read, ("unv", "uff", "uf", "ufb"))
