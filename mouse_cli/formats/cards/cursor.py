"""Where the reader stands in the deck: takes cards, reads fields, says where and why that failed."""

from dataclasses import dataclass, field

from mouse_cli._span import Span
from mouse_cli.formats.cards.findings import Findings
from mouse_cli.formats.cards.images import SEQUENCE_COLUMN, Images
from mouse_cli.formats.cards.layout import Field, Group
from mouse_cli.formats.edit import FieldError, clean_reader, field_warnings, read_field

BLANK = " " * 80
SUSPICIONS = {"no-point": "MD124", "trailing-blank": "MD125", "embedded-blank": "MD126"}


@dataclass
class Cursor:
    """The next card is number `at` (from 0). `trace` remembers what each card was taken for."""

    images: Images
    findings: Findings
    legacy: bool = False
    overrides: dict[str, float] = field(default_factory=dict)
    overridden: set[str] = field(default_factory=set)
    at: int = 0
    trace: list[tuple[int, Group, int]] = field(default_factory=list)

    def take(self, group: Group, items: int = 0) -> int:
        """Index of the next card, which belongs to `group` and follows `items` items of it.

        Raises DeckError at the end of the deck.
        """
        if self.at >= len(self.images.cards):
            self._refuse_end(group, items)
        self.trace.append((self.at, group, items))
        self.at += 1
        return self.at - 1

    def peek(self) -> str:
        """The next card, blank beyond the end."""
        return self.images.cards[self.at] if self.at < len(self.images.cards) else BLANK

    def span(self, index: int, field: Field) -> Span:
        """The whole of one field."""
        return self.images.span(index, field.column, field.width)

    def place(self, index: int, field: Field, group: Group) -> str:
        """Card, group, columns and text of a field, for messages."""
        return self.place_at(index, group, field.column, field.width)

    def place_at(self, index: int, group: Group, column: int, width: int) -> str:
        """Card, group, columns and text of `width` columns from `column`, for messages."""
        last = column + width - 1
        text = self.images.cards[index][column - 1 : last]
        return f'card {index + 1}, {group.title}, columns {column}-{last}: "{text}"'

    def value(self, index: int, field: Field, ordinal: int, group: Group, warn: bool = True) -> float | int | None:
        """What a field holds; None after an error. `overrides` come first, by the name of the field."""
        if self.overrides or self.images.stripped:
            label = field.label(ordinal)
            if label in self.overrides:
                self.overridden.add(label)
                return self.overrides[label]
            if self.images.stripped and field.column + field.width > SEQUENCE_COLUMN:
                return self._refuse_stripped(index, field, label, group)
        value = clean_reader(field.format.kind)(field.cut(self.images.cards[index]))
        return value if value is not None else self._peculiar(index, field, field.label(ordinal), group, warn)

    def warn_of(self, index: int, field: Field, label: str, group: Group) -> None:
        """Warn of a legal field that is seldom what was meant."""
        for found in field_warnings(field.cut(self.images.cards[index]), str(field.format)):
            message = f"{label}: {found.reason} ({self.place(index, field, group)})"
            self.findings.warn(SUSPICIONS[found.kind], message, self.span(index, field), help=found.help)

    def refuse_used(self, index: int, group: Group, fields: tuple[Field, ...], note: str = "") -> None:
        """Unused fields must be blank or zero: a READ list would ignore them in silence."""
        for one in fields:
            text = one.cut(self.images.cards[index])
            if text.strip(" 0+-."):
                self.findings.error(
                    "MD107",
                    f"a field past the end of the list is not blank ({self.place(index, one, group)})",
                    self.span(index, one),
                    note or "the count on the control card ends the list before this field",
                    "blank these columns, or mend the count on the control card",
                )

    def _peculiar(self, index: int, field: Field, label: str, group: Group, warn: bool) -> float | int | None:
        """The exact reading of a field that is not plain."""
        text = field.cut(self.images.cards[index])
        try:
            value = read_field(text, str(field.format))
        except FieldError as error:
            self._refuse(index, field, label, group, error)
            return None
        if warn and value:
            self.warn_of(index, field, label, group)
        return value

    def _refuse(self, index: int, field: Field, label: str, group: Group, error: FieldError) -> None:
        legal = f"; legal: {field.row.legal}" if field.row.legal else ""
        column = "" if error.offset is None else f", column {field.column + error.offset}"
        self.findings.error(
            "MD101",
            f"{label} cannot be read: {error.reason}{column} ({self.place(index, field, group)})",
            self.span(index, field),
            f"expected {field.format}: {field.row.meaning.format(i='i')}{legal}",
            error.help,
        )

    def _refuse_stripped(self, index: int, field: Field, label: str, group: Group) -> None:
        self.findings.error(
            "MD127",
            f"{label} was lost with columns 73-80 ({self.place(index, field, group)})",
            self.span(index, field),
            "without those columns the field is cut short, or gone",
            "punch the card again" if group.is_input else f"give it by --set '{label}=VALUE', or punch the card again",
        )

    def _refuse_end(self, group: Group, items: int) -> None:
        last = len(self.images.lines)
        done = f"after {items} items of it" if items else "before its first card"
        self.findings.stop(
            "MD100",
            f"the deck ends at card {last}, in {group.title}, {done}; expected {group.cards} card(s), "
            f"ended by: {group.ended}",
            self.images.span(max(0, last - 1)),
            "all twelve groups are always present; each group read by INPUT ends with its own blank card",
            f"add a blank card at the end of group {group.number}" if group.is_input and items else _missing(group),
        )


def _missing(group: Group) -> str:
    if group.number < 7:
        return f"punch the cards of group {group.number} and all that follow"
    number = group.number
    return f"punch the cards of group {number}, or look for a missing blank card before group {number}"


def blanks_are_zeros(field: Field, card: str, value: int) -> tuple[str, str]:
    """Note and help for an integer that blanks have made large; both empty when they did not."""
    text = field.cut(card)
    digits = text.strip(" ")
    if not digits or (text.endswith(digits) and " " not in digits):
        return "", ""
    column = field.column + field.width - 1
    return (
        f'a blank inside or after a number is a zero (trailing blanks are zeros), so "{text}" is {value}',
        f"move the {digits} to column {column}" if len(digits) == 1 else f"end the {digits} in column {column}",
    )


def reads_as(card: str, group: Group) -> bool:
    """Whether a card looks like one of `group`: all that is punched are unbroken legal numbers."""
    texts = [(one.cut(card), str(one.format)) for one in group.fields]
    return any(text.strip() for text, _ in texts) and all(_unbroken(text, format) for text, format in texts)


def _unbroken(text: str, format: str) -> bool:
    try:
        read_field(text, format)
    except FieldError:
        return False
    return " " not in text.strip(" ")
