"""A FORTRAN edit descriptor (Iw, Ew.d, A4) and the error of a field that it does not accept."""

import re
from dataclasses import dataclass
from functools import cache

SMALLEST, LARGEST = 1.5e-39, 1.7e38  # UNIVAC 1108 single precision: 8-bit exponent, excess 128
LARGEST_INTEGER = 34_359_738_367  # 36-bit word
WIDEST = 255

_DESCRIPTOR = re.compile(r"(?:(I|A)([0-9]{1,3})|(E)([0-9]{1,3})\.([0-9]{1,3}))").fullmatch


class FieldError(ValueError):
    """A field cannot be read or written: `reason`, `help` and, when one column is to blame, its `offset`
    from 0.

    `index` is the position of the field in a bulk read.
    """

    def __init__(self, reason: str, help: str = "", offset: int | None = None, index: int | None = None):
        super().__init__(reason)
        self.reason, self.help, self.offset, self.index = reason, help, offset, index


@dataclass(frozen=True, slots=True)
class Format:
    """One edit descriptor: `kind` I, E or A, width w, and d digits after the implied point."""

    kind: str
    width: int
    digits: int = 0

    def __str__(self) -> str:
        return f"E{self.width}.{self.digits}" if self.kind == "E" else f"{self.kind}{self.width}"


@cache
def parse(format: str) -> Format:
    """The descriptor written as text.

    >>> parse("E14.8")
    Format(kind='E', width=14, digits=8)
    """
    match = _DESCRIPTOR(format)
    if not match:
        raise ValueError(f"'{format}' is not an edit descriptor; expected Iw, Ew.d or Aw")
    simple, width, real, real_width, digits = match.groups()
    found = Format(simple or real, int(width or real_width), int(digits or 0))
    if not 1 <= found.width <= WIDEST:
        raise ValueError(f"'{format}' has a width outside 1 to {WIDEST}")
    return found


@cache
def expand(format: str) -> tuple[Format, ...]:
    """The descriptors of a whole card, in order of the columns, with repeat counts and brackets multiplied
    out.

    >>> [str(f) for f in expand("2(2I3,E14.8)")]
    ['I3', 'I3', 'E14.8', 'I3', 'I3', 'E14.8']
    """
    match = re.fullmatch(r"(\d*)\((.*)\)", format)
    if match:
        inner = [one for part in match[2].split(",") for one in expand(part)]
        return tuple(inner) * int(match[1] or 1)
    match = re.fullmatch(r"(\d*)([A-Z].*)", format)
    if not match:
        raise ValueError(f"'{format}' is not a FORMAT")
    return (parse(match[2]),) * int(match[1] or 1)
