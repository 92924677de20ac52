"""Cards of a Nastran bulk data or punch file: small, large and free fields, with their continuations."""

import re
from collections.abc import Iterator
from dataclasses import dataclass

from mouse_cli._span import Span
from mouse_cli.formats.data_files import line_span, reject, text_lines

_SHORT_EXPONENT = re.compile(r"(?<=[0-9.])([+-][0-9]+)$")  # 1.5-3 is 1.5E-3
_BEGUN = re.compile(r"\s*BEGIN\s+(SUPER\s*=\s*0\s+)?BULK", re.IGNORECASE)


@dataclass(frozen=True)
class Card:
    """name, in capitals; fields after it, blanks stripped, continuations included; the line (from 1) it begins on."""

    name: str
    fields: list[str]
    line: int


class Bulk:
    """The cards of a file; `path` and its lines, for diagnostics.

    source: lines from elsewhere than the file as it is, such as from files that it includes, each with the place it stands at.
    """

    def __init__(self, path: str, source: list[tuple[str, str, int]] | None = None):
        self.path = path
        self.lines = text_lines(path) if source is None else [text for text, _, _ in source]
        self._source = source
        begun = (i for i, line in enumerate(self.lines, 1) if _BEGUN.match(line))
        self.begun = next(begun, 0)  # lines of executive and case control, which are no cards

    def cards(self, wanted: str | None = None) -> Iterator[Card]:
        """The cards called `wanted`, which others may stand between; None: all of them."""
        card: Card | None = None
        for number, raw in enumerate(self.lines[self.begun :], self.begun + 1):
            line = raw.split("$", 1)[0].rstrip()
            line = line if "," in line else line.expandtabs(8)
            if not line.strip():
                continue
            if line.upper().startswith("ENDDATA"):
                break
            if line[0] in "+*," or not line[:8].strip(", "):
                if card is not None:
                    card.fields.extend(self._fields(line, number))
                continue
            if card is not None:
                yield card
            name = re.split(r"[,*\s]", line[:8].lstrip(), maxsplit=1)[0].upper()
            card = Card(name, self._fields(line, number), number) if wanted in (None, name) else None
        if card is not None:
            yield card

    def _fields(self, line: str, number: int) -> list[str]:
        if line.count(",") > 9:
            message = "a line in free format has at most eight fields and a continuation mark"
            reject("MD252", self.path, message, "continue on the next line", line_span(*self.place(number), line))
        return _fields(line)

    def place(self, number: int) -> tuple[str, int]:
        """File and line (from 1) of line `number` of all."""
        return (self.path, number) if self._source is None else self._source[number - 1][1:]

    def where(self, card: Card) -> Span:
        """Place of the first line of a card."""
        return line_span(*self.place(card.line), self.lines[card.line - 1])

    def whole(self, card: Card, field: int, low: int = 0) -> int:
        """A field (from 0) as a whole number of at least `low`; 0 when it is empty."""
        text = _at(card, field)
        if text and not (text.isascii() and text.isdigit() and len(text) < 10 and int(text) >= low):
            self.refuse(
                card, f"field {field + 2} of this {card.name} is '{text[:16]}'; expected a whole number from {low}"
            )
        return int(text or 0)

    def real(self, card: Card, field: int) -> float:
        """A field (from 0) as a number; 0 when it is empty."""
        text = _at(card, field).upper().replace("D", "E")
        try:
            return float((text if "E" in text else _SHORT_EXPONENT.sub(r"E\1", text)) or 0)
        except ValueError:
            self.refuse(card, f"field {field + 2} of this {card.name} is '{text[:16]}'; expected a number")

    def refuse(self, card: Card, message: str, help: str = "write the file again") -> None:
        """MD252 at a card."""
        reject("MD252", self.path, message, help, self.where(card))


def _at(card: Card, field: int) -> str:
    return card.fields[field] if field < len(card.fields) else ""


def _fields(line: str) -> list[str]:
    """Fields of one line after the first: 8 of 8 columns, or 4 of 16 when the first bears an asterisk."""
    large = "*" in line[:8].split(",", 1)[0]
    count, width = (4, 16) if large else (8, 8)
    if "," in line:
        found = [field.strip() for field in line.split(",")[1 : count + 1]]
        return found + [""] * (count - len(found))
    return [line[8 + i * width : 8 + (i + 1) * width].strip() for i in range(count)]
