"""Why a field was refused, in words: looked for only after the reader has said no."""

import re

from mouse_cli.formats.edit.descriptor import FieldError, Format

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
