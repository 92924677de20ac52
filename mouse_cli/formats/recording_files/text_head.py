"""What stands before the numbers of a table as text: names, units, and lines that state how it was sampled."""

import re
from collections.abc import Sequence
from dataclasses import dataclass

from mouse_cli.model.channel_units import unit

COMMENTS = "#%!"
_SAMPLING = r"(?:sampl\w*|scan|abtast|mess)[ _-]?"
_RATES = rf"f_?s|{_SAMPLING}(?:rate|freq\w*)|rate|samples per second"
_STEPS = rf"d_?t|t_?s|delta[ _-]?t|time[ _-]?(?:step|increment)|{_SAMPLING}(?:interval\w*|period|schritt)"
_STATED = re.compile(
    rf"(?:(?P<rate>{_RATES})|(?P<step>{_STEPS}))"
    r"\s*(?:[(\[](?P<inside>[^)\]]*)[)\]])?[\s:=;,]+(?P<number>[0-9.,]+(?:[eE][-+]?[0-9]+)?)[\s;,]*(?P<unit>[^\s;,]*)",
    re.IGNORECASE,
)
_LABEL = re.compile(r"([\w ]+):", re.ASCII)
_NAMES = ("channel names", "channel name", "channels", "names")
_PER_SECOND = {
    "hz": 1.0,
    "khz": 1e3,
    "mhz": 1e6,
    "s/s": 1.0,
    "sa/s": 1.0,
    "samples/s": 1.0,
    "1/s": 1.0,
    "sps": 1.0,
    "ks/s": 1e3,
}
_SECONDS = {"s": 1.0, "sec": 1.0, "seconds": 1.0, "ms": 1e-3, "us": 1e-6, "µs": 1e-6, "μs": 1e-6}
_NO_UNITS = ("s", "sec", "ms", "hz", "-", "")
_LONGEST = 300  # characters of a line that is looked at
_LONGEST_UNIT = 8  # characters of one that is not known, in a line of units


@dataclass(frozen=True)
class Head:
    """names (c,), numbers from 1 where none stand there; units (c,); sample_rate_hz: that stated, None where it is not."""

    names: list[str]
    units: list[str]
    sample_rate_hz: float | None


def labelled(lines: Sequence[str], i: int) -> str:
    """The label, `dt` of a line `dt:`, that stands alone above line `i`; empty where none does."""
    above = next((line for line in reversed(lines[:i]) if line.strip()), "")
    found = _LABEL.fullmatch(above[:_LONGEST].strip().strip("\"'"))
    return found[1].strip().lower() if found else ""


def read_head(lines: Sequence[str], cells, width: int, comma: bool) -> Head:
    """The head of a table of `width` columns; cells(line): those of a line; comma: numbers are written with a decimal comma."""
    rows, rate = [], None
    for i, line in enumerate(lines):
        plain = line.strip().lstrip(COMMENTS).strip()
        label = labelled(lines, i)
        found = _stated(f"{label}: {plain}" if label else plain, comma)
        rate = rate or found
        row = cells(line.lstrip().lstrip(COMMENTS))
        if found or not plain or len(row) < width or any(row[width:]) or not any(row[:width]):
            continue
        if label in _NAMES:
            rows = [row[:width]]
            break
        if not (label or _LABEL.fullmatch(plain[:_LONGEST])):
            rows.append(row[:width])
    rate = rate or next(filter(None, (_below(lines, i, comma) for i in range(len(lines)))), None)
    names, units = _named(rows, width)
    return Head(names, units, rate)


def _below(lines: Sequence[str], i: int, comma: bool) -> float | None:
    """The rate that line `i` states for the label above it."""
    label = labelled(lines, i)
    return _stated(f"{label}: {lines[i].strip()}", comma) if label else None


def _stated(line: str, comma: bool) -> float | None:
    """Samples a second that a line states, `fs = 512 Hz`, `Sampling interval: 0.001 s`; None where it states none."""
    found = _STATED.match(line[:_LONGEST].replace('"', ""))
    if found is None:
        return None
    number = found["number"].rstrip(",.")
    if "," in number:
        head, _, rest = number.partition(",")
        number = (
            f"{head}.{rest}" if comma and "," not in rest and "." not in number else head if "." in head else number
        )
    try:
        value = float(number)
    except ValueError:  # 1,000: nobody can say which of two
        return None
    spelled = (found["inside"] or found["unit"]).strip("[]()").lower()
    if spelled in _SECONDS or (found["step"] and spelled not in _PER_SECOND):
        value = 1 / (value * _SECONDS.get(spelled, 1.0)) if value > 0 else 0.0
    else:
        value *= _PER_SECOND.get(spelled, 1.0)
    return value if 0 < value < float("inf") else None


def _named(rows: list[list[str]], width: int) -> tuple[list[str], list[str]]:
    """Names and units of the columns, from the rows of the head that have as many cells."""
    units = [""] * width
    at = next((k for k in range(len(rows) - 1, max(0, len(rows) - 4), -1) if _are_units(rows[k])), None)
    if at is not None:
        units, rows = [cell.strip("[]()") for cell in rows[at]], rows[:at]
    names = list(rows[-1]) if rows else [""] * width
    for j, name in enumerate(names):
        stem, said = _parted(name)
        if stem and said is not None:
            names[j], units[j] = stem, units[j] or said
    return [name or str(j + 1) for j, name in enumerate(names)], units


def _parted(name: str) -> tuple[str, str | None]:
    """`acc3` and `g` of `acc3 (g)` or `acc3 [g]`; None for a name without a unit."""
    at = min((i for i in (name.find("("), name.find("[")) if i >= 0), default=-1)
    return (name[:at].rstrip(), name[at + 1 : -1]) if at >= 0 and name.endswith((")", "]")) else (name, None)


def _are_units(cells: list[str]) -> bool:
    """Whether most cells are units that are known, and the rest short words, such as a temperature's."""
    plain = [cell.strip("[]()") for cell in cells]
    known = [bool(unit(cell)) or cell.lower() in _NO_UNITS for cell in plain]
    others = [cell for cell, is_known in zip(plain, known, strict=True) if not is_known]
    short = all(len(cell) <= _LONGEST_UNIT and not any(c.isdigit() for c in cell) for cell in others)
    return any(unit(cell) for cell in plain) and 2 * sum(known) > len(cells) and short
