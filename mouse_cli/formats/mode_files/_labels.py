"""What the heads of columns and rows of a table of modes say: frequencies and their units, sd, damping, parts of complex shapes."""

import re
from dataclasses import dataclass

import numpy as np

_UNIT = r"\s*[\[(]?\s*({})?\s*[\])]?"
_HZ = {"hz": 1.0, "khz": 1e3, "rad/s": 1 / (2 * np.pi), "1/min": 1 / 60, "rpm": 1 / 60, "cpm": 1 / 60}  # of one, in Hz
_PERIODS = {"s": 1.0, "sec": 1.0, "ms": 1e-3}  # of one, in s
_ANY = "|".join(map(re.escape, (*_HZ, *_PERIODS)))
_FREQUENCY = re.compile(
    r"((?:natural |eigen)?(?:frequency|frequencies|freq\.?)|fn?|(?:circular |angular )?(?:omega|frequency)|periods?)"
    + _UNIT.format(_ANY), re.IGNORECASE)  # fmt: skip
_SD = re.compile(r"(?:sd|std|sigma|frequency[ _]sd|sd of frequency|f[ _]sd)" + _UNIT.format(f"{_ANY}|%"), re.IGNORECASE)
_DAMPING = re.compile(r"(damping(?: ratio)?|zeta|loss factor|eta)" + _UNIT.format("%"), re.IGNORECASE)
_PARTS = {"amplitude": "size", "amp": "size", "amp.": "size", "magnitude": "size", "mag": "size", "abs": "size",
          "phase": "phase", "real": "real", "re": "real", "imaginary": "imag", "imag": "imag", "im": "imag"}  # fmt: skip
_PART = rf"(?P<part{{}}>{'|'.join(map(re.escape, sorted(_PARTS, key=len, reverse=True)))})"
_MODE = re.compile(
    rf"(?:{_PART.format(1)}[ _:,-]*)?(?:mode|shape|phi)?[ _#]*(?P<number>[0-9]+)(?![.,]?[0-9])"
    r"(?:\s*[\[(]?\s*(?P<hz>[0-9.,]+)\s*hz\s*[\])]?)?"
    rf"(?:[ _:,-]*\(?{_PART.format(2)}\)?)?(?:\s*[\[(]?\s*(?P<unit>deg(?:rees?)?|°|rad)\s*[\])]?)?", re.IGNORECASE)  # fmt: skip
_ONLY_HZ = re.compile(r"(?:mode|shape)?\s*[\[(]?\s*([0-9]+(?:[.,][0-9]+)?)\s*hz\s*[\])]?", re.IGNORECASE)
_MODE_SD = re.compile(r"(?:(?:mode|shape)[ _#]*([0-9]+)[ _]*sd|sd[ _]*(?:mode|shape)?[ _#]*([0-9]+))", re.IGNORECASE)


@dataclass(frozen=True)
class ModeLabel:
    """Head of a column of a shape: mode (0 without a number); hz, NaN where not said; part: real, imag, size, phase; degrees."""

    number: int
    hz: float = np.nan
    part: str = "real"
    degrees: bool | None = None


def mode_label(text: str) -> ModeLabel | None:
    """Of a head such as `mode 1 (12.31 Hz)`, `12.31 Hz`, `mode 1 phase [deg]`; None for others."""
    if alone := _ONLY_HZ.fullmatch(text):
        return ModeLabel(0, float(alone[1].replace(",", ".")))
    found = _MODE.fullmatch(text)
    if not found:
        return None
    unit = (found["unit"] or "").lower()
    part = _PARTS[(found["part1"] or found["part2"] or "real").lower()]
    if unit and part != "phase":
        return None
    return ModeLabel(int(found["number"]), _decimal(found["hz"]), part, unit != "rad" if unit else None)


def sd_of_mode(text: str) -> int | None:
    """The number of the mode whose column of standard deviations a head names; None for others."""
    found = _MODE_SD.fullmatch(text)
    return int(found[1] or found[2]) if found else None


def _decimal(text: str | None) -> float:
    try:
        return float((text or "nan").replace(",", "."))
    except ValueError:
        return np.nan


@dataclass(frozen=True)
class ValueLabel:
    """Head of values of modes; kind: frequency, sd, damping; unit: its own, in lower case, empty where not said."""

    kind: str
    unit: str
    halved: bool = False


def value_label(text: str) -> ValueLabel | None:
    """Of `frequency [rad/s]`, `omega`, `period`, `sd [%]`, `damping`, `loss factor`; None for others."""
    if found := _FREQUENCY.fullmatch(text):
        word, unit = found[1].lower(), (found[2] or "").lower()
        default = "s" if word.startswith("period") else "rad/s" if re.search("omega|circular|angular", word) else ""
        return ValueLabel("frequency", unit or default)
    if found := _SD.fullmatch(text):
        return ValueLabel("sd", (found[1] or "").lower())
    if found := _DAMPING.fullmatch(text):
        return ValueLabel("damping", found[2] or "", found[1].lower() in ("loss factor", "eta"))
    return None


def in_hz(values: np.ndarray, unit: str) -> np.ndarray:
    """Frequencies, or periods, of that unit in Hz."""
    with np.errstate(divide="ignore"):
        return 1 / (values * _PERIODS[unit]) if unit in _PERIODS else values * _HZ[unit or "hz"]


def sd_in_hz(values: np.ndarray, unit: str, hz: np.ndarray, of: str) -> np.ndarray:
    """Standard deviations in Hz of frequencies `hz`; unit: their own, else that of the frequencies, `of`."""
    unit = unit or of
    if unit == "%":
        return values / 100 * hz
    return values * _PERIODS[unit] * hz**2 if unit in _PERIODS else values * _HZ[unit or "hz"]


def ratio(values: np.ndarray, label: ValueLabel) -> np.ndarray:
    """Damping ratios: a loss factor is twice as large."""
    return values / (100 if label.unit == "%" else 1) / (2 if label.halved else 1)
