"""Routine INPUT, which reads groups 6, 7, 9, 11 and 12: four elements a card, until a blank card."""

from dataclasses import dataclass, field

import numpy as np

from mouse_cli._span import Span
from mouse_cli.formats.cards.cursor import BLANK, Cursor, blanks_are_zeros, reads_as
from mouse_cli.formats.cards.layout import GROUPS, Field, Group
from mouse_cli.formats.draft import Entries
from mouse_cli.formats.edit import clean_reader

Item = tuple[Field, Field, Field]


@dataclass
class Matrix:
    """A matrix while it is read: its shape, and the elements found so far with card and slot of each."""

    group: Group
    rows: int
    cols: int
    symmetric: bool = False
    next_shape: tuple[int, int] | None = None
    elements: dict[tuple[int, int], tuple[float, int, int]] = field(default_factory=dict)
    end: int = 0
    errors_before: int = 0

    def entries(self, cursor: Cursor) -> Entries:
        """The elements as listed, each with its place."""
        indices = np.array(list(self.elements), dtype=np.int64).reshape(-1, 2)
        values = np.array([value for value, _, _ in self.elements.values()], dtype=float)
        places = [(card, slot) for _, card, slot in self.elements.values()]
        return Entries(indices[:, 0], indices[:, 1], values, lambda i: slot_span(cursor, self.group, *places[i]))


def slot_span(cursor: Cursor, group: Group, card: int, slot: int) -> Span:
    """The 20 columns of one element."""
    item = group.items[slot]
    return cursor.images.span(card, item[0].column, sum(field.width for field in item))


def read_input(cursor: Cursor, matrix: Matrix) -> Matrix:
    """Read elements until the card that ends the group. Raises DeckError when its end has been missed."""
    matrix.errors_before = cursor.findings.errors
    while True:
        card = cursor.take(matrix.group, len(matrix.elements))
        if cursor.images.cards[card] == BLANK or not _read_card(cursor, matrix, card):
            matrix.end = card
            return matrix


def refuse_empty(cursor: Cursor, matrix: Matrix) -> None:
    """A matrix without elements means a blank card too many; what follows would be read as something else."""
    if not matrix.elements and cursor.findings.errors == matrix.errors_before:
        cursor.findings.stop(
            "MD116",
            f"{matrix.group.symbol} has no elements (card {matrix.end + 1}, {matrix.group.title})",
            cursor.images.span(matrix.end),
            "every blank card ends a group",
            f"delete the blank card, or punch the elements of {matrix.group.symbol}",
        )


def _read_card(cursor: Cursor, matrix: Matrix, card: int) -> bool:
    """The elements of one card; False when the card holds only zeros and so ends the group."""
    errors, before = cursor.findings.errors, len(cursor.findings.diagnostics)
    used = [
        slot for slot, item in enumerate(matrix.group.items) if _read_slot(cursor, matrix, card, slot, item, before)
    ]
    if not used and cursor.findings.errors == errors:
        message = f"a card of zeros ends the group (card {card + 1}, {matrix.group.title})"
        cursor.findings.warn("MD115", message, cursor.images.span(card), help="use a blank card")
        return False
    if used and used[0] > 0 and cursor.findings.errors == errors:
        cursor.findings.warn(
            "MD114",
            f"the first of the four elements is empty (card {card + 1}, {matrix.group.title})",
            slot_span(cursor, matrix.group, card, 0),
            "a reader that looks only at the first row index would end the group here",
            "start each card with its first element",
        )
    return True


def _read_slot(cursor: Cursor, matrix: Matrix, card: int, slot: int, item: Item, before: int) -> bool:
    """One element; True when the slot is in use."""
    row, col, value = _plain(cursor, matrix.group.cuts[slot], card)
    if row is None or col is None or value is None:
        texts = [cursor.images.cards[card][cut] for cut in matrix.group.cuts[slot]]
        if not "".join(texts).strip(" "):
            return False
        row, col, value = (cursor.value(card, f, 1, matrix.group, warn=f is item[2]) for f in item)
    if row is None or col is None or value is None:
        _stop_if_group_has_ended(cursor, matrix, card, before)
    if row is None or col is None or (row == col == 0 and value == 0):
        return row is None or col is None
    if not (0 < row <= matrix.rows and 0 < col <= matrix.cols):
        _refuse_index(cursor, matrix, card, slot, (row, col, value), before)
    elif value is not None:
        _add(cursor, matrix, card, slot, (row, col, value))
    return True


def _plain(cursor: Cursor, cuts: tuple[slice, ...], card: int) -> tuple[int | None, int | None, float | None]:
    """The element when nothing about it is peculiar; such are nearly all, and this is the quick way."""
    if cursor.images.stripped:
        return None, None, None
    text = cursor.images.cards[card]
    row, col, value = cuts
    return _INTEGER(text[row]), _INTEGER(text[col]), _REAL(text[value])


_INTEGER, _REAL = clean_reader("I"), clean_reader("E")


def _add(cursor: Cursor, matrix: Matrix, card: int, slot: int, element: tuple[int, int, float]) -> None:
    row, col, value = element
    if row >= 10 or col >= 10:
        _warn_of_indices(cursor, matrix, card, slot)
    key = (col, row) if matrix.symmetric and (col, row) in matrix.elements else (row, col)
    if key in matrix.elements:
        _refuse_twice(cursor, matrix, card, slot, element, key)
    else:
        matrix.elements[key] = (value, card, slot)


def _warn_of_indices(cursor: Cursor, matrix: Matrix, card: int, slot: int) -> None:
    """An index below ten cannot have been made large by blanks; others are looked at."""
    for place in matrix.group.items[slot][:2]:
        if " " in place.cut(cursor.images.cards[card]).lstrip(" "):
            cursor.warn_of(card, place, place.row.name, matrix.group)


def _refuse_twice(cursor: Cursor, matrix: Matrix, card: int, slot: int, element: tuple, key: tuple[int, int]) -> None:
    """The same place twice: an error, unless both say the same."""
    row, col, value = element
    symbol, (first, first_card, _) = matrix.group.symbol, matrix.elements[key]
    note_it = cursor.findings.warn if first == value else cursor.findings.error
    following = _following(matrix.group)
    missing = f"; missing blank card before group {following.number}?" if following and following.is_input else ""
    mirror = ", its mirror image" if key != (row, col) else ""
    note_it(
        "MD112",
        f"{symbol}({row},{col}) is given twice: {first:.8g} on card {first_card + 1}{mirror}, {value:.8g} here "
        f"({_slot_place(cursor, matrix, card, slot)})",
        slot_span(cursor, matrix.group, card, slot),
        "whether the first, the last or the sum was meant cannot be known",
        f"delete one of the two{missing}",
    )


def _refuse_index(cursor: Cursor, matrix: Matrix, card: int, slot: int, element: tuple, before: int) -> None:
    """An element outside the matrix, with the likely cause."""
    row, col, _ = element
    _stop_if_group_has_ended(cursor, matrix, card, before)
    code = "MD110" if row and col else "MD111"
    message = (
        f"{matrix.group.symbol}({row},{col}) is outside {matrix.rows} x {matrix.cols} "
        f"({_slot_place(cursor, matrix, card, slot)})"
    )
    span, text = slot_span(cursor, matrix.group, card, slot), cursor.images.cards[card]
    if matrix.next_shape and 0 < row <= matrix.next_shape[0] and 0 < col <= matrix.next_shape[1]:
        cursor.findings.forget(before)
        following = _following(matrix.group)
        note = f"it would fit {following.symbol}, which comes next"
        cursor.findings.stop(code, message, span, note, f"missing blank card before group {following.number}?")
    hints = (
        blanks_are_zeros(place, text, index) for place, index in zip(matrix.group.items[slot], (row, col), strict=False)
    )
    note, help = next((hint for hint in hints if hint[0]), ("", ""))
    fallback = f"give a row from 1 to {matrix.rows} and a column from 1 to {matrix.cols}, right justified"
    cursor.findings.error(code, message, span, note, help or fallback)


def _stop_if_group_has_ended(cursor: Cursor, matrix: Matrix, card: int, before: int) -> None:
    """When the card reads as one of the next group, the blank card before that group is missing."""
    following = _following(matrix.group)
    if following is None or following.is_input or not reads_as(cursor.images.cards[card], following):
        return
    cursor.findings.forget(before)
    cursor.findings.stop(
        "MD111",
        f"the card holds numbers and no indices (card {card + 1}, {matrix.group.title})",
        cursor.images.span(card),
        f"it reads as a card of {following.title}",
        f"missing blank card before group {following.number}?",
    )


def _following(group: Group) -> Group | None:
    return GROUPS[group.number] if group.number < len(GROUPS) else None


def _slot_place(cursor: Cursor, matrix: Matrix, card: int, slot: int) -> str:
    span = slot_span(cursor, matrix.group, card, slot)
    return cursor.place_at(card, matrix.group, span.column, span.width)
