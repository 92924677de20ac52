"""Texts from decks and recordings made harmless where they are shown, on terminals and in cells of spreadsheets; capitals."""

import csv
import io
import re
from collections.abc import Iterable

# Controls but tabs and line ends, marks that turn the direction of writing or show nothing, halves of characters.
_UNSEEN = re.compile(
    "[\x00-\x08\x0b-\x1f\x7f-\x9f\xad\u061c\u115f\u1160\u180e\u200b-\u200f\u2028-\u202e\u2060-\u206f\u3164\ufe00-\ufe0f\ufeff\uffa0"
    "\ufff9-\ufffb\ud800-\udfff\U000e0000-\U000e0fff]"
)
# What servers take for a command of theirs at the beginning of a line, after blanks too: `::error::`, `##[group]`, `##vso[`.
_COMMAND = re.compile(r"^([ \t]*)(?::(?=:)|#(?=#(?:vso)?\[))", re.MULTILINE)
_FORMULA = ("=", "+", "-", "@")


def shown(text: str, commands: bool = False) -> str:
    """`text` with a question mark for whatever moves the cursor, turns the writing round, cannot be seen or is a command to the
    server that keeps the log (unless `commands` are meant); lines stay.

    >>> shown("mode\\x1b[2J 1\\u202e"), shown("é\\n"), shown("a::b\\n  ::error::forged\\n##[endgroup]")
    ('mode?[2J 1?', 'é\\n', 'a::b\\n  ?:error::forged\\n?#[endgroup]')
    """
    text = _UNSEEN.sub("?", text)
    return text if commands else _COMMAND.sub(r"\1?", text)


def line(text: str) -> str:
    """The same on one line."""
    return shown(text).replace("\n", "?").replace("\t", " ")


def capital(text: str) -> str:
    """`text` as it begins a sentence.

    >>> capital("mode 3 of TX")
    'Mode 3 of TX'
    """
    return text[:1].upper() + text[1:]


def cell(value: object) -> str:
    """A cell of a table: numbers to all digits, NaN as nothing; texts on one line.

    An apostrophe stands before those that begin like a formula: spreadsheets compute them, quoted or not.

    >>> [cell(value) for value in ("=1+1", -0.5, "k1", None)]
    ["'=1+1", '-0.5', 'k1', '']
    """
    if value is None or value != value:
        return ""
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, int | float):
        return repr(float(value)) if isinstance(value, float) else str(value)
    text = line(str(value))
    return f"'{text}" if text.lstrip().startswith(_FORMULA) else text


def csv_text(rows: Iterable[Iterable[object]]) -> str:
    """A table for spreadsheets and data frames, no cell of which is a formula."""
    stream = io.StringIO()
    csv.writer(stream, lineterminator="\n").writerows([cell(value) for value in row] for row in rows)
    return stream.getvalue()
