"""The user's manual of card decks, set anew from the layout: every card drawn, every field explained."""

from collections.abc import Iterator

from mouse_cli._errors import RULER
from mouse_cli.formats.cards.layout import COLUMNS, GROUPS, Field, Group

_HEAD = """# Card decks

A deck is a text file with one card of 80 columns on each line: twelve groups, all of them, in this order.

Integers are right justified. An all-blank field is 0; **a blank inside or after a number is the digit 0**.
Real numbers carry a decimal point; without one the last d digits of an Ew.d field are the fraction, also
when an exponent is punched. Exponents are written `E5`, `E+05`, `D5` or `+05`, and nothing, not even a
blank, follows them.
"""

_INPUT = """Matrices (groups 6, 7, 9, 11 and 12) are read by routine INPUT: up to four elements a card, in
any order, each with its row, its column and its value. Only nonzero elements need to be given. A blank card
ends the group. A negative
number leaves no room for a leading zero: punch `-.12345678E+06` or `-1.2345678E+05`.
"""


def manual() -> str:
    """All groups: a table of contents, then each card."""
    return "\n".join([_HEAD, _INPUT, *_contents(), *(line for group in GROUPS for line in _group(group))]) + "\n"


def _contents() -> Iterator[str]:
    yield "| group | name | symbol | FORMAT | cards | ended by |"
    yield "|---|---|---|---|---|---|"
    for g in GROUPS:
        yield f"| {g.number} | {g.name} | {g.symbol} | {g.format} | {g.cards} | {g.ended} |"
    yield ""


def _group(group: Group) -> Iterator[str]:
    """One group: its card drawn, its text, its fields in a table."""
    yield f"## Group {group.number}: {group.name}{f' ({group.symbol})' if group.symbol else ''}"
    yield ""
    yield f"FORMAT {group.format}. Cards: {group.cards}; ended by: {group.ended}."
    yield ""
    yield from ("```", *RULER, _drawn(group), "```", "")
    yield from (group.text, "")
    yield "| columns | name | FORMAT | meaning | unit | legal |"
    yield "|---|---|---|---|---|---|"
    fields = group.fields if group.symbol or len(group.rows) > 1 else ()
    yield from (_row(field, k // len(group.rows) + 1) for k, field in enumerate(fields))
    if not fields:
        yield f"| 1-{COLUMNS} | {group.rows[0].name} | {group.format} | {group.rows[0].meaning} | | |"
    yield ""


def _drawn(group: Group) -> str:
    """The card with a bar in the first column of every field, and one after the last."""
    edges = "".join("|" + "-" * (field.width - 1) for field in group.fields)
    return edges[:COLUMNS] + "|"


def _row(field: Field, ordinal: int) -> str:
    row, label = field.row, field.label(ordinal)
    cells = (field.columns, label, field.format, row.meaning.format(i=ordinal), row.unit, row.legal)
    return f"| {' | '.join(map(str, cells))} |"
