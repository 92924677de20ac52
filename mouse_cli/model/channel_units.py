"""Units of measured channels: what quantity each belongs to, and what one of it is in SI units."""

import re
from dataclasses import dataclass

from mouse_cli.model.units import UNDECLARED, Units

G = 9.80665  # m/s2, standard gravity (3rd CGPM, 1901)
_INCH, _FOOT, _POUND = 0.0254, 0.3048, 4.4482216152605  # m, m, N: exact, by the agreement of 1959
SI = {
    "force": "N",
    "moment": "N m",
    "displacement": "m",
    "velocity": "m/s",
    "acceleration": "m/s2",
    "rotation": "rad",
    "angular velocity": "rad/s",
    "angular acceleration": "rad/s2",
    "sound": "Pa",
}
_LENGTHS = {"m": 1.0, "cm": 1e-2, "mm": 1e-3, "um": 1e-6, "nm": 1e-9, "in": _INCH, "ft": _FOOT}
_FORCES = {"N": 1.0, "mN": 1e-3, "kN": 1e3, "MN": 1e6, "lbf": _POUND, "lb": _POUND, "kip": 1e3 * _POUND, "kgf": G}
_MOMENTS = {
    "N m": 1.0,
    "Nm": 1.0,
    "N*m": 1.0,
    "N.m": 1.0,
    "kN m": 1e3,
    "kNm": 1e3,
    "N mm": 1e-3,
    "lbf in": _POUND * _INCH,
}
_ANGLES = {"rad": 1.0, "mrad": 1e-3, "deg": 0.017453292519943295}
_TABLE: dict[str, tuple[str, float]] = {
    **{unit: ("force", factor) for unit, factor in _FORCES.items()},
    **{unit: ("moment", factor) for unit, factor in _MOMENTS.items()},
    **{unit: ("displacement", factor) for unit, factor in _LENGTHS.items()},
    **{f"{unit}/s": ("velocity", factor) for unit, factor in _LENGTHS.items()},
    **{f"{unit}/s2": ("acceleration", factor) for unit, factor in _LENGTHS.items()},
    **{unit: ("acceleration", factor) for unit, factor in {"g": G, "gn": G, "mg": 1e-3 * G, "Gal": 1e-2}.items()},
    **{unit: ("rotation", factor) for unit, factor in _ANGLES.items()},
    **{f"{unit}/s": ("angular velocity", factor) for unit, factor in _ANGLES.items()},
    **{f"{unit}/s2": ("angular acceleration", factor) for unit, factor in _ANGLES.items()},
    **{unit: ("sound", factor) for unit, factor in {"Pa": 1.0, "mPa": 1e-3, "kPa": 1e3}.items()},
    **{unit: ("voltage", factor) for unit, factor in {"V": 1.0, "mV": 1e-3, "uV": 1e-6}.items()},
}
COMMON = {  # units in which channels of a quantity come mostly
    "acceleration": ("m/s2", "g", "mm/s2"),
    "velocity": ("m/s", "mm/s", "in/s"),
    "displacement": ("m", "mm", "um", "in"),
    "force": ("N", "kN", "lbf", "kgf"),
}
_SPELLINGS = (("²", "2"), ("**", ""), ("^", ""), ("µ", "u"), ("μ", "u"), ("·", " "))
_SAME = {"meter": "m", "metre": "m", "newton": "N", "volt": "V", "inch": "in"}
_SAME_UNIT = 0.02  # relative, of a gain that was estimated
_INVERSE = re.compile(r"\(1/([^()]+)\)\s*[*·]?\s*\(?([^()]+)\)?")  # as Testlab writes it
_SECONDS = re.compile(r"/\s*(sec|s)(?=[2\s/)]|$)", re.IGNORECASE)


@dataclass(frozen=True, slots=True)
class Unit:
    """One of a unit is `factor` of the SI unit of its quantity."""

    quantity: str
    factor: float


def unit(text: str) -> Unit | None:
    """The unit that `text` spells, as `m/s2`, `m/s^2`, `mm/s²`, `g`, `lbf`; None where it is none that is known.

    >>> unit("mm/s^2")
    Unit(quantity='acceleration', factor=0.001)
    """
    name = _plain(text)
    found = _TABLE.get(name) or next((_TABLE[key] for key in _TABLE if key.lower() == name.lower()), None)
    return None if found is None else Unit(*found)


def _plain(text: str) -> str:
    name = text.strip().strip("[]").strip()
    if name.startswith("(") and name.endswith(")") and name.count("(") == 1:
        name = name[1:-1]
    for other, spelling in _SPELLINGS:
        name = name.replace(other, spelling)
    name = (
        _SECONDS.sub("/s", re.sub(r"\s+", " ", name))
        .replace("/s/s", "/s2")
        .replace("m s-2", "m/s2")
        .replace("m s-1", "m/s")
    )
    return _SAME.get(name.lower(), name)


def read_as(quantity: str, name: str, gain: float) -> str:
    """The common unit of a quantity of which numbers are, where reading them in the unit `name` makes them `gain` times as large.

    >>> read_as("acceleration", "m/s2", 1 / 9.80665), read_as("acceleration", "m/s2", 1.3)
    ('g', '')
    """
    stated = unit(name)
    others = [each for each in COMMON.get(quantity, ()) if stated is not None and unit(each) != stated]
    return next((each for each in others if abs(gain * unit(each).factor / stated.factor - 1) < _SAME_UNIT), "")


def ratio(text: str) -> tuple[Unit, Unit] | None:
    """The units above and below a stroke, as of `(m/s2)/N`, `g/N`, `mV/(m/s2)`: the last one that has units on both sides, or None.

    >>> [each.quantity for each in ratio("g/lbf")]
    ['acceleration', 'force']
    """
    turned = _INVERSE.fullmatch(text.strip())
    text = f"{turned[2]}/{turned[1]}" if turned else text
    strokes = [k for k, letter in enumerate(text) if letter == "/"]
    pairs = ((unit(text[:k]), unit(text[k + 1 :])) for k in reversed(strokes))
    return next((pair for pair in pairs if None not in pair), None)


def target(quantity: str, units: Units = UNDECLARED) -> tuple[str, float]:
    """The unit of `quantity` in a deck of such units, SI where none are declared, and what one of it is in SI; ("", 1) for others.

    >>> from mouse_cli.model.units import SYSTEMS
    >>> target("acceleration"), target("moment", SYSTEMS["mm-t-N"])
    (('m/s2', 1.0), ('N mm', 0.001))
    """
    if not units.declared:
        return SI.get(quantity, ""), 1.0
    length, force = units.metre, unit(units.force).factor
    return {
        "force": (units.force, force),
        "moment": (f"{units.force} {units.length}", force * length),
        "displacement": (units.length, length),
        "velocity": (f"{units.length}/s", length),
        "acceleration": (f"{units.length}/s2", length),
    }.get(quantity, (SI.get(quantity, ""), 1.0))
