"""A card deck laid open: each card under a column ruler, with every field cut out, named and valued."""

from collections.abc import Iterator, Sequence

from mouse_cli._errors import RULER
from mouse_cli.formats.cards import layout
from mouse_cli.formats.cards.cursor import BLANK, Cursor
from mouse_cli.formats.cards.layout import Field, Group
from mouse_cli.formats.cards.reader import trace
from mouse_cli.formats.draft import Draft
from mouse_cli.formats.edit import FieldError, read_field


def describe(source: Draft | str | bytes | Sequence[str], **options: object) -> str:
    """Every card of a deck, group by group; also of a deck that cannot be read to its end, up to that place.

    `options` are those of the reader (legacy, strip_73_80, overrides).
    """
    if isinstance(source, Draft):
        source = source.source.lines
    text = source if isinstance(source, (str, bytes)) else "".join(f"{line}\n" for line in source)
    cursor = trace(text, **options)
    lines = [line for card in _cards(cursor) for line in card]
    return "\n".join([*lines, *_unread(cursor), ""])


def _cards(cursor: Cursor) -> Iterator[list[str]]:
    """The lines of each card; a group is announced at its first."""
    shown, ruler = None, [f"     | {row}" for row in RULER]
    for index, group, items in cursor.trace:
        title = f"Group {group.number}: {group.name}  {group.symbol}  {group.format}"
        head = [] if group is shown else ["", title, *ruler]
        shown = group
        card = f"{index + 1:>4} | {cursor.images.cards[index].rstrip()}"
        yield [*head, card, *_fields(cursor, index, group, items)]


def _fields(cursor: Cursor, index: int, group: Group, items: int) -> Iterator[str]:
    """One line for every field, or element, that is punched."""
    card = cursor.images.cards[index]
    if group is layout.HEADING:
        yield _line(f"1-{layout.COLUMNS}", "heading", card.rstrip())
    elif card == BLANK:
        yield _line("", "blank card", f"ends group {group.number}" if group.is_input else "zeros")
    elif group.is_input:
        yield from (
            _element(group, item, card) for item in group.items if any(field.cut(card).strip() for field in item)
        )
    else:
        size = len(group.rows) if group is layout.RS else 1
        for k, field in enumerate(group.fields):
            if field.cut(card).strip():
                yield _named(field, card, items + k // size + 1)


def _named(field: Field, card: str, ordinal: int) -> str:
    """Columns, name, value and meaning of one field."""
    unit = f" {field.row.unit}" if field.row.unit else ""
    return _line(
        field.columns,
        field.label(ordinal),
        f"{_value(field, card)}{unit}",
        field.row.meaning.format(i=ordinal),
    )


def _element(group: Group, item: tuple[Field, Field, Field], card: str) -> str:
    row, col, value = item
    columns = f"{row.column}-{value.column + value.width - 1}"
    return _line(
        columns,
        f"{group.symbol}({_value(row, card)},{_value(col, card)})",
        _value(value, card),
        value.row.meaning,
    )


def _value(field: Field, card: str) -> str:
    """The value as it is read, or the text and why it cannot be."""
    text = field.cut(card)
    try:
        value = read_field(text, str(field.format))
    except FieldError as error:
        return f'"{text}" ({error.reason})'
    return f"{value:.10g}" if isinstance(value, float) else str(value)


def _line(columns: str, name: str, value: str, meaning: str = "") -> str:
    return f"     |   {columns:>7}  {name:<18} {value:<20} {meaning}".rstrip()


def _unread(cursor: Cursor) -> Iterator[str]:
    """Say where reading stopped when cards are left over."""
    rest = [i for i in range(cursor.at, len(cursor.images.cards)) if cursor.images.cards[i] != BLANK]
    if rest:
        yield ""
        yield f"Cards {rest[0] + 1} to {rest[-1] + 1} were not read."
