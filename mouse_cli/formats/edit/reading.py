"""Fields read as FORTRAN V read them.

All-blank is 0; leading blanks are skipped; every other blank is the digit 0 (FORTRAN 66, `BLANK='ZERO'`). A
real without a point has its last d digits after the point, also when an exponent is punched; the exponent
may be written `E5 E+5 D5 +05`. What FORTRAN reads only by accident, or into nonsense, is refused with a
reason.
"""

import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from mouse_cli.formats.edit.descriptor import LARGEST, LARGEST_INTEGER, SMALLEST, FieldError, Format, parse

_INTEGER = re.compile(r"([+-]?)([0-9 ]*)").fullmatch
_REAL = re.compile(r"([+-]?)([0-9 ]*)(?:(\.)([0-9 ]*))?(?:([EeDd][+-]?|[+-])([0-9 ]*))?").fullmatch
# Fields that Python reads as FORTRAN does: a point, no blank after the first character, exponent with E.
_CLEAN_REAL = re.compile(r" *[+-]?(?:[0-9]+\.[0-9]*|\.[0-9]+)(?:[Ee][+-]?[0-9]+)?").fullmatch
# The same with the exponents that only FORTRAN knows: 1.28872+04 and 1.28872D4.
_CLEAN_AS_PRINTED = re.compile(r"( *[+-]?(?:[0-9]+\.[0-9]*|\.[0-9]+))(?:[Dd](?=.)|(?=[+-]))([+-]?[0-9]+)").fullmatch
_BLANK_AFTER_EXPONENT = re.compile(r" *[0-9 ]*[1-9][0-9]*( )").match

Value = float | int | str


@dataclass(frozen=True, slots=True)
class Suspicion:
    """A legal field that is seldom what was meant: `kind` no-point, trailing-blank or embedded-blank."""

    kind: str
    reason: str
    help: str


def read_field(text: str, format: str) -> Value:
    """The value of one field. A text shorter than the field is a record that ends there; a card never does: pad it first.

    Raises FieldError when the field is refused.

    >>> read_field("    1.28872+04", "E14.8"), read_field("         85000", "E14.8"), read_field("4   ", "I4")
    (12887.2, 0.00085, 4000)
    """
    descriptor = parse(format)
    text = text.removesuffix("\n").removesuffix("\r")
    if len(text) > descriptor.width:
        raise FieldError(f"{len(text)} characters do not fit a field of {descriptor.width}", "keep within the columns")
    if descriptor.kind == "A":
        return text.ljust(descriptor.width)
    read = _integer if descriptor.kind == "I" else _real
    return read(text.lstrip(" "), text, descriptor)


def read_fields(texts: Sequence[str], format: str) -> np.ndarray:
    """Many fields at once, as an array of int or float: the same values, and the same refusals, as
    `read_field`.

    Raises FieldError for the first refused field, with its `index`.
    """
    descriptor = parse(format)
    if descriptor.kind == "A":
        return np.array([read_field(text, format) for text in texts], dtype=f"U{descriptor.width}")
    clean, width = clean_reader(descriptor.kind), descriptor.width
    values = [clean(text) if len(text) == width else None for text in texts]
    for i, value in enumerate(values):
        if value is None:
            values[i] = _numbered(texts[i], format, i)
    return np.array(values, dtype=np.int64 if descriptor.kind == "I" else np.float64)


def clean_reader(kind: str) -> Callable[[str], Value | None]:
    """A fast reader of fields of kind I or E that have no peculiarity; it answers None for all others."""
    return _CLEAN[kind]


def field_warnings(text: str, format: str) -> tuple[Suspicion, ...]:
    """What is legal but suspicious in a field that `read_field` accepts; a zero is never suspicious."""
    descriptor = parse(format)
    text = text.removesuffix("\n").removesuffix("\r")
    if descriptor.kind == "A" or not re.search(r"[1-9]", text):
        return ()
    return tuple(_suspicions(text, descriptor))


def _numbered(text: str, format: str, index: int) -> Value:
    try:
        return read_field(text, format)
    except FieldError as error:
        raise FieldError(error.reason, error.help, error.offset, index) from None


def _clean_integer(text: str) -> int | None:
    digits = text.lstrip(" ")
    return int(digits) if digits.isdigit() and digits.isascii() and len(digits) < 11 else None


def _clean_real(text: str) -> float | None:
    if _CLEAN_REAL(text):
        value = float(text)
    elif match := _CLEAN_AS_PRINTED(text):
        value = float(f"{match[1]}E{match[2]}")
    else:
        return None
    return value if 1e-30 < abs(value) < 1e30 else None  # near the limits, and zero, the exact path decides


_CLEAN = {"I": _clean_integer, "E": _clean_real}


def _integer(body: str, text: str, descriptor: Format) -> int:
    if not body:
        return 0
    match = _INTEGER(body)
    if not match or not match[2].strip(" "):
        raise why_not(text, descriptor)
    value = int(match[1] + match[2].replace(" ", "0"))
    if abs(value) > LARGEST_INTEGER:
        raise FieldError(f"{value} does not fit a 36-bit word", f"give at most {LARGEST_INTEGER}")
    return value


def _real(body: str, text: str, descriptor: Format) -> float:
    """Sign, mantissa and exponent, the point implied d digits from the end when none is punched."""
    if not body:
        return 0.0
    match = _REAL(body)
    if not match:
        raise why_not(text, descriptor)
    sign, whole, point, fraction, letter, exponent = match.groups("")
    if not (whole + fraction).strip(" ") or (letter and not exponent.strip(" ")):
        raise why_not(text, descriptor)
    _refuse_blank_after_exponent(exponent, text, descriptor)
    power = int(letter.lstrip("EeDd") + exponent.replace(" ", "0")) if letter else 0
    if not point:
        power -= descriptor.digits
    return _in_range(float(f"{sign}{whole}.{fraction}E{power}".replace(" ", "0")), whole + fraction)


def _refuse_blank_after_exponent(exponent: str, text: str, descriptor: Format) -> None:
    match = _BLANK_AFTER_EXPONENT(exponent)
    if match:
        trailing = len(text) - len(text.rstrip(" "))
        raise FieldError(
            "there is a blank after the exponent, which multiplies the exponent by ten",
            f"move the number {trailing} column{'s' * (trailing > 1)} to the right" if trailing else "close the gap",
            len(text) - len(exponent) + match.start(1) if len(text) == descriptor.width else None,
        )


def _in_range(value: float, mantissa: str) -> float:
    if SMALLEST <= abs(value) <= LARGEST or not re.search("[1-9]", mantissa):
        return value
    raise FieldError(
        f"the value is outside {SMALLEST:.1E} to {LARGEST:.1E}, the range of the 1108's single precision",
        "choose units that bring the value within that range",
    )


def _suspicions(text: str, descriptor: Format) -> Iterator[Suspicion]:
    """The warnings of a nonzero field, found in the mantissa (reals) or in the whole number (integers)."""
    mantissa = re.split(r"[EeDd]|(?<=[0-9. ])[+-]", text.lstrip(" "))[0] if descriptor.kind == "E" else text
    if descriptor.kind == "E" and "." not in mantissa:
        yield Suspicion(
            "no-point",
            f"no decimal point: the last {descriptor.digits} digits are taken as the fraction",
            "punch the decimal point",
        )
    if re.search(r"[0-9.] +(?=[0-9.])", text):
        yield Suspicion("embedded-blank", "a blank inside a number is a zero", "punch the zero")
    digits = mantissa.rstrip(" ")
    if "." not in mantissa and len(digits) < len(mantissa):
        count = len(mantissa) - len(digits)
        yield Suspicion(
            "trailing-blank",
            f"each blank after an integer multiplies it by ten, here {count} time{'s' * (count > 1)}",
            f"move the number {count} column{'s' * (count > 1)} to the right",
        )


# Tried in order; the first pattern that is found names the fault and its column.
_FAULTS = (
    (r"^ *(\*+) *$", "asterisks are FORTRAN's overflow mark: the number did not fit", "give the number"),
    (r"(\t)", "a tab is not a card code", "replace the tab with blanks"),
    (r"([^\x20-\x7e])", "only printable ASCII characters can be punched", "retype the character"),
    (r"(,)", "a comma is not allowed in a field", "put the number in its columns; nothing separates fields"),
    (r"(?i)([+-]?(?:nan|inf(?:inity)?))", "it is not a number", "give a finite number"),
    (r"(_)", "an underscore is not allowed in a number", "delete the underscore"),
)  # fmt: skip
_INTEGER_FAULTS = (
    (r"(\.)", "an integer has no decimal point", "give an integer, right justified"),
    (r"(?i)[0-9 ]([ed])[+-]?[0-9 ]*$", "an integer has no exponent", "write the integer out"),
    (r"[0-9] *([+-])", "a sign stands after the digits", "put the sign in front of the number"),
)
_REAL_FAULTS = (
    (
        r"(?i)(?:[ed][+-]?|[0-9. ][+-])[0-9 ]*(\.)",
        "there is a point in the exponent",
        "give the exponent as an integer",
    ),
    (r"\.[^.]*(\.)", "there are two decimal points", "leave one point"),
    (
        r"(?i)^ *[+-]?[. ]*([ed][+-]?[0-9 ]*)$",
        "there is an exponent, but no number before it",
        "punch the number",
    ),
    (r"^ *([+-]) *$", "there is a sign, but no digit", "punch the number, or leave the field blank"),
    (
        r"(?i)[0-9. ]([ed] *[+-]?|[+-]) *$",
        "there are no digits after the exponent",
        "punch the exponent, or nothing",
    ),
)
_LAST_FAULTS = (
    (r"([+-]) *[+-]", "there are two signs", "leave one sign"),
    (r"([^0-9+\-.EeDd ])", "this character is not allowed in a number", "retype the number"),
    (r"([A-Za-z])", "this letter is not allowed here", "retype the number"),
    (r"^ *([+-]) *$", "there is a sign, but no digit", "punch the number, or leave the field blank"),
    (r"(\.)", "there is a point, but no digit", "punch the number, or leave the field blank"),
)


def why_not(text: str, descriptor: Format) -> FieldError:
    """The error to raise for a field that does not follow the grammar of `descriptor`."""
    own = _INTEGER_FAULTS if descriptor.kind == "I" else _REAL_FAULTS
    for pattern, reason, help in (*_FAULTS, *own, *_LAST_FAULTS):
        match = re.search(pattern, text)
        if match:
            return FieldError(reason, help, match.start(1))
    expected = "[sign] digits" if descriptor.kind == "I" else "[sign] digits . digits [exponent]"
    return FieldError(f"it does not follow {expected}", "retype the number")
