"""Group 2, the ten control integers: sizes, loop counts and switches of the whole deck."""

from dataclasses import dataclass

from mouse_cli._span import Span
from mouse_cli.formats.cards.cursor import Cursor, blanks_are_zeros
from mouse_cli.formats.cards.layout import CONTROLS, Field

SIZES = ("N", "NM", "IROW", "INTR", "NRS")  # without these no later card can be found
LOOPS = ("ITERMX", "NPARD")
_PLACEHOLDER = {"NVEC": 0}  # of an integer that has been refused already; the others are taken as 1


@dataclass(frozen=True)
class Control:
    """The control integers, under the report's names, and where each was punched."""

    N: int
    NM: int
    NVEC: int
    JFLAG: int
    KONF: int
    IROW: int
    ITERMX: int
    INTR: int
    NRS: int
    NPARD: int
    card: int
    where: dict[str, Span]

    @property
    def data(self) -> int:
        """Number of data, NM(1+IROW)."""
        return self.NM * (1 + self.IROW)


def read_control(cursor: Cursor) -> Control:
    """The control card. Raises DeckError when a size is impossible: no later card can then be found."""
    card = cursor.take(CONTROLS)
    values, where = {}, {}
    for field in CONTROLS.fields:
        name = field.row.name
        where[name] = cursor.span(card, field)
        values[name] = _legal(cursor, card, field, values)
    if any(values[name] is None for name in SIZES):
        cursor.findings.give_up()
    usable = {name: _PLACEHOLDER.get(name, 1) if value is None else value for name, value in values.items()}
    return Control(**usable, card=card, where=where)


def check_nvec(cursor: Cursor, control: Control, highest: int) -> None:
    """NVEC is the number of the highest measured mode."""
    if highest and control.NVEC and highest != control.NVEC:
        conflict = f"but the highest measured mode is MODE({control.NM}) = {highest}"
        _refuse(cursor, control.card, _field("NVEC"), control.NVEC, conflict)


def _field(name: str) -> Field:
    return next(field for field in CONTROLS.fields if field.row.name == name)


def _legal(cursor: Cursor, card: int, field: Field, before: dict[str, int | None]) -> int | None:
    """One integer, checked against its bounds and against those punched before it; None after an error."""
    value = cursor.value(card, field, 1, CONTROLS, warn=False)
    if value is None:
        if "," in cursor.images.cards[card]:  # in free format, all other fields are wrong for the same reason
            cursor.findings.give_up()
        return None
    row, bound = field.row, before.get(field.row.at_most)
    if value <= 0 and row.name in LOOPS and cursor.legacy:
        return _once(cursor, card, field, value)
    if value < row.low or (row.high and value > row.high):
        return _refuse(cursor, card, field, value, f"expected {_expected(field)}")
    if bound is not None and value > bound:
        return _refuse(cursor, card, field, value, f"but the model has {row.at_most} = {bound}")
    _check_limit(cursor, card, field, value)
    cursor.warn_of(card, field, row.name, CONTROLS)
    return value


def _expected(field: Field) -> str:
    """The legal range; sizes beyond the 1972 storage are allowed as far as an index field reaches."""
    row = field.row
    return f"{row.low} to {row.high}" if row.limit and row.high else row.legal


def _refuse(cursor: Cursor, card: int, field: Field, value: int, conflict: str) -> None:
    note, help = blanks_are_zeros(field, cursor.images.cards[card], value)
    cursor.findings.error(
        "MD104",
        f"{field.row.name} reads {value}, {conflict} ({cursor.place(card, field, CONTROLS)})",
        cursor.span(card, field),
        note or f"{field.row.name} is the {field.row.meaning}; legal: {field.row.legal}",
        help or f"punch {field.row.name} right justified in columns {field.columns}",
    )


def _once(cursor: Cursor, card: int, field: Field, value: int) -> int:
    cursor.findings.warn(
        "MD104",
        f"{field.row.name} reads {value} and is taken as 1 ({cursor.place(card, field, CONTROLS)})",
        cursor.span(card, field),
        "a FORTRAN 66 DO loop runs once for an upper limit of 0",
        f"punch {field.row.name}",
    )
    return 1


def _check_limit(cursor: Cursor, card: int, field: Field, value: int) -> None:
    limit = field.row.limit
    if limit is None or value <= limit:
        return
    note_it = cursor.findings.error if cursor.legacy else cursor.findings.warn
    note_it(
        "MD121",
        f"{field.row.name} is {value}; the 1972 program holds at most {limit} ({cursor.place(card, field, CONTROLS)})",
        cursor.span(card, field),
        help="read the deck without --legacy"
        if cursor.legacy
        else "keep within the limit if the old program is to read it",
    )
