"""Numbers written into fields of a fixed width: the twin of `reading`."""

from collections.abc import Iterator
from math import isfinite

from mouse_cli.formats.edit.descriptor import LARGEST, LARGEST_INTEGER, SMALLEST, FieldError, parse


def write_field(value: float | int | str, format: str) -> str:
    """`value` in exactly w characters, right justified (text: left), with as many significant digits as fit.

    Whenever some form of w columns holds a real exactly, such a form is chosen, so that reading it gives
    `value` again. Raises FieldError when the value cannot be represented.

    >>> write_field(-123456.78, "E14.8"), write_field(8485.2814, "E14.8"), write_field(1.25e-20, "E9.2")
    ('    -123456.78', '     8485.2814', ' 1.25E-20')
    """
    descriptor = parse(format)
    write = {"A": _text, "I": _integer, "E": _real}[descriptor.kind]
    return write(value, descriptor.width, descriptor.digits)


def _text(value: str, width: int, _: int) -> str:
    if len(value) > width or not value.isascii() or not value.isprintable():
        raise FieldError(f"'{value}' is not {width} printable ASCII characters", f"shorten it to {width}")
    return value.ljust(width)


def _integer(value: int, width: int, _: int) -> str:
    text = str(int(value))
    if len(text) > width or abs(value) > LARGEST_INTEGER or value != int(value):
        raise FieldError(f"{value} is not an integer of {width} columns", "give a smaller integer")
    return text.rjust(width)


def _real(value: float, width: int, digits: int) -> str:
    """The shortest digits that name `value`; where they do not fit, as many as do."""
    if not isfinite(value) or (value and not SMALLEST <= abs(value) <= LARGEST):
        raise FieldError(f"{value} is outside {SMALLEST:.1E} to {LARGEST:.1E}", "choose other units")
    value = float(value)
    sign = "-" if str(value).startswith("-") else ""
    for mantissa, power in _roundings(abs(value)):
        for form in _forms(mantissa, power, digits):
            if len(sign) + len(form) <= width:
                return (sign + form).rjust(width)
    raise FieldError(f"{value} does not fit {width} columns in any form", "choose other units")


def _roundings(value: float) -> Iterator[tuple[str, int]]:
    """Digits and power of ten, value = digits * 10**power: those that name the double, then fewer."""
    exact = _scientific(repr(value))
    yield exact
    for count in range(len(exact[0]) - 1, 0, -1):
        yield _scientific(f"{value:.{count - 1}e}")


def _scientific(text: str) -> tuple[str, int]:
    """Digits without zeros at either end, and the power of ten of the last one."""
    number, _, exponent = text.partition("e")
    whole, _, fraction = number.partition(".")
    digits = (whole + fraction).lstrip("0")
    short = digits.rstrip("0")
    return short or "0", (int(exponent or 0) - len(fraction) + len(digits) - len(short)) if short else 0


def _forms(mantissa: str, power: int, implied: int) -> Iterator[str]:
    """Every way to write the number that may save a column, the plainest first, without a point last."""
    plain, scientific = _fixed(mantissa, power), _exponential(mantissa, power, len(mantissa) - 1, "E{:+03d}")
    yield min(plain, scientific, key=len)
    yield plain
    yield scientific
    for pattern in ("E{:+03d}", "E{:+d}", "{:+d}"):
        for decimals in range(len(mantissa), -1, -1):
            if power + decimals:
                yield _exponential(mantissa, power, decimals, pattern)
    yield from _pointless(mantissa, power + implied)


def _fixed(mantissa: str, power: int) -> str:
    """Without exponent: `250000.`, `8485.2814`, `.05`."""
    if power >= 0:
        return f"{mantissa}{'0' * power}."
    padded = mantissa.rjust(-power, "0")
    return f"{padded[:power]}.{padded[power:]}"


def _exponential(mantissa: str, power: int, decimals: int, pattern: str) -> str:
    """With `decimals` digits after the point: `1.2345678E+05`, `.12345678+6`."""
    split = len(mantissa) - decimals
    return f"{mantissa[:split]}.{mantissa[split:]}{pattern.format(power + decimals)}"


def _pointless(mantissa: str, power: int) -> Iterator[str]:
    """With the implied point, which saves a column: legal, though the reader warns of it."""
    if power >= 0:
        yield mantissa + "0" * power
    if power:
        yield f"{mantissa}{power:+d}"
