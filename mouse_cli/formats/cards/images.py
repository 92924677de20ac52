"""A text file as card images: lines cut at LF, padded with blanks to 80 columns before any field is cut.

A card always had 80 columns, and a blank after a digit is a zero; so an editor that strips trailing blanks
must change nothing. What no card can hold (tabs, other characters, text past column 80, a ninth field of
card numbers) is found here.
"""

import re
from collections import Counter
from dataclasses import dataclass, field

from mouse_cli._span import Span
from mouse_cli.formats.cards.findings import Findings
from mouse_cli.formats.cards.layout import COLUMNS
from mouse_cli.formats.data_files import decoded

SEQUENCE_COLUMN = 73
ENOUGH_NUMBERED = 0.8  # of the cards

_NOT_PUNCHABLE = re.compile(r"[^\x20-\x7e]")
_CARD_NUMBER = re.compile(r"[A-Za-z]*([0-9]+)").fullmatch


@dataclass
class Images:
    """lines: as in the file, without line ends. cards: the same in 80 columns, ready to be cut."""

    path: str
    lines: list[str]
    cards: list[str] = field(default_factory=list)
    stripped: bool = False

    def span(self, index: int, column: int = 1, width: int = COLUMNS) -> Span:
        """A place on a card; beyond the last card, the end of the deck."""
        text = self.lines[index] if index < len(self.lines) else ""
        return Span(self.path, index + 1, column, width, text, card=True)


def images(text: str | bytes, path: str, *, strip_73_80: bool = False) -> Images:
    """The cards of a deck, whatever is on them."""
    lines, last = _lines(text), SEQUENCE_COLUMN - 1 if strip_73_80 else COLUMNS
    return Images(path, lines, [line[:last].ljust(COLUMNS) for line in lines], strip_73_80)


def check(deck: Images, findings: Findings) -> None:
    """Note what no card can hold. Raises DeckError for characters that shift columns, and card numbers."""
    _check_characters(deck, findings)
    if not deck.stripped and numbered(deck.cards):
        _refuse_numbers(deck, findings)


def _lines(text: str | bytes) -> list[str]:
    """Lines without LF or CR LF; a last line without LF counts."""
    if isinstance(text, bytes | bytearray):
        text = decoded(bytes(text))
    lines = text.removeprefix("\ufeff").split("\n")
    if lines[-1] == "":
        lines.pop()
    return [line.removesuffix("\r") for line in lines]


def _check_characters(deck: Images, findings: Findings) -> None:
    """Past column 80 anything but blanks is an error; so are tabs, and all that is not printable ASCII."""
    damaged = False
    for index, line in enumerate(deck.lines):
        if len(line) > COLUMNS and line[COLUMNS:].strip(" "):
            _refuse_beyond(deck, index, line, findings)
        if not (line.isascii() and line.isprintable()):
            damaged |= _refuse_characters(deck, index, findings)
    if damaged:
        findings.give_up()


def _refuse_beyond(deck: Images, index: int, line: str, findings: Findings) -> None:
    text = line[COLUMNS:].strip(" ")
    column = COLUMNS + 1 + line[COLUMNS:].index(text[0])
    findings.error(
        "MD102",
        f'card {index + 1} has text beyond column {COLUMNS}: "{text[:20]}" from column {column}',
        deck.span(index, column, len(text)),
        f"a card has {COLUMNS} columns; the 1972 reader did not see what is written after them",
        f"delete everything after column {COLUMNS}, or move it to its columns",
    )


def _refuse_characters(deck: Images, index: int, findings: Findings) -> bool:
    """Note the first unpunchable character of a card; in the heading only a tab is fatal."""
    card = deck.cards[index]
    found = "\t" if "\t" in card else next(iter(_NOT_PUNCHABLE.findall(card)), "")
    if not found:
        return False
    span = deck.span(index, card.index(found) + 1, 1)
    if index == 0 and found != "\t":
        deck.cards[0] = _NOT_PUNCHABLE.sub("?", card)
        message = f"the heading holds {found!a}, which cannot be punched; it becomes ?"
        findings.warn("MD106", message, span, help="use plain ASCII")
        return False
    name = "a tab" if found == "\t" else f"the character {found!a}"
    findings.error(
        "MD103",
        f"card {index + 1} has {name} in column {span.column}",
        span,
        "a card holds printable ASCII characters, one a column; a tab would have to be guessed",
        "replace it with blanks so that every field stands in its columns",
    )
    return True


def numbered(cards: list[str]) -> bool:
    """Whether columns 73-80 hold card numbers: unbroken, rising by one step, on four cards in five."""
    last = [card[SEQUENCE_COLUMN - 1 :].strip(" ") for card in cards]
    numbers = {i: int(match[1]) for i, text in enumerate(last) if (match := _CARD_NUMBER(text))}
    enough = max(3, ENOUGH_NUMBERED * len(cards))
    if len(numbers) < enough:
        return False
    steps = Counter(numbers[i + 1] - n for i, n in numbers.items() if i + 1 in numbers)
    step = max(steps, key=steps.get, default=0)
    starts = Counter(n - step * i for i, n in numbers.items())
    return step > 0 and max(starts.values()) >= enough


def _refuse_numbers(deck: Images, findings: Findings) -> None:
    findings.stop(
        "MD105",
        f"the cards have sequence numbers in columns {SEQUENCE_COLUMN}-{COLUMNS}",
        deck.span(min(1, len(deck.lines) - 1), SEQUENCE_COLUMN, COLUMNS - SEQUENCE_COLUMN + 1),
        f"all {COLUMNS} columns are data: on the control card these are NPARD",
        "blank those columns with --strip-73-80, and give NPARD and the other values that stood there",
    )
