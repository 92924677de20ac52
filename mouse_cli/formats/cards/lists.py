"""Groups that are lists ended by a count: MODE, RS, INDIC, LAMTST and VAR."""

from dataclasses import dataclass, field

import numpy as np

from mouse_cli._span import Span
from mouse_cli.formats.cards.control import Control, check_nvec
from mouse_cli.formats.cards.cursor import Cursor, reads_as
from mouse_cli.formats.cards.layout import INDIC, LAMTST, MODE, MOST_INDIC_CARDS, RS, VAR, Field, Group
from mouse_cli.formats.draft import Entries


@dataclass
class Listed:
    """The values of a list with the card and field of each."""

    cursor: Cursor
    values: list[float] = field(default_factory=list)
    places: list[tuple[int, Field]] = field(default_factory=list)

    def where(self, i: int) -> Span | None:
        """Place of the i-th value, from 0."""
        return self.cursor.span(*self.places[i]) if i < len(self.places) else None

    def add(self, value: float | None, card: int, place: Field, unreadable: float) -> None:
        """One more value; `unreadable` stands for one that has been refused already."""
        self.values.append(unreadable if value is None else value)
        self.places.append((card, place))


def read_mode(cursor: Cursor, control: Control) -> Listed:
    """Group 3: the system mode number of each measured mode."""
    modes = _counted(cursor, MODE, control.NM, unreadable=0)
    check_nvec(cursor, control, modes.values[-1])
    return modes


def read_lamtst(cursor: Cursor, control: Control) -> Listed:
    """Group 8: natural frequencies in Hz."""
    return _counted(cursor, LAMTST, control.NM, unreadable=float("nan"))


def read_var(cursor: Cursor, control: Control) -> Listed:
    """Group 10: standard deviations of the data, frequencies first and eigenvectors on without a new card."""
    note = "the eigenvector values go on where the frequencies end, without a new card"
    listed = _counted(cursor, VAR, control.data, unreadable=1.0, note=note)
    if reads_as(cursor.peek(), VAR):
        cursor.findings.stop(
            "MD120",
            f"VAR seems to run on: the card after its {control.data} values, NM(1+IROW) with NM = "
            f"{control.NM} and "
            f"IROW = {control.IROW}, holds numbers and no indices (card {cursor.at + 1}, {VAR.title})",
            cursor.images.span(cursor.at),
            note,
            f"punch exactly {control.data} values, five a card",
        )
    return listed


def _counted(cursor: Cursor, group: Group, count: int, unreadable: float, note: str = "") -> Listed:
    """`count` values, so many a card as the FORMAT says, and nothing after the last."""
    listed, fields = Listed(cursor), group.fields
    for start in range(0, count, len(fields)):
        card = cursor.take(group, start)
        used = fields[: count - start]
        for k, place in enumerate(used, start + 1):
            listed.add(cursor.value(card, place, k, group), card, place, unreadable)
        cursor.refuse_used(card, group, fields[len(used) :], note)
    return listed


def read_rs(cursor: Cursor, control: Control) -> Entries:
    """Group 4: stiffness elements (value 0), one pair 0 0, mass elements (value 1)."""
    rows, cols, errors = Listed(cursor), Listed(cursor), cursor.findings.errors
    count = control.NRS + 1
    for start in range(0, count, len(RS.items)):
        card = cursor.take(RS, start)
        for k, (row, col) in enumerate(RS.items[: count - start], start + 1):
            rows.add(cursor.value(card, row, k, RS), card, row, 0)
            cols.add(cursor.value(card, col, k, RS), card, col, 0)
        cursor.refuse_used(card, RS, tuple(f for pair in RS.items[count - start :] for f in pair))
    overfull = cursor.findings.errors > errors
    pairs = np.array([rows.values, cols.values], dtype=np.int64)
    zeros = np.flatnonzero(~pairs.any(axis=0))
    if len(zeros) != 1:
        _refuse_separators(cursor, control, zeros, rows)
        if overfull or len(zeros) > 1:  # NRS is wrong, and so is where every later card is looked for
            cursor.findings.give_up()
    return _split(control, pairs, zeros, rows)


def _split(control: Control, pairs: np.ndarray, zeros: np.ndarray, places: Listed) -> Entries:
    """Take out the pair 0 0 that stands between stiffness and mass."""
    at = int(zeros[0]) if len(zeros) else control.NRS
    keep = np.delete(np.arange(control.NRS + 1), at)
    where = lambda i: places.cursor.images.span(places.places[keep[i]][0], places.places[keep[i]][1].column, 8)
    return Entries(pairs[0, keep], pairs[1, keep], (keep > at).astype(float), where)


def _refuse_separators(cursor: Cursor, control: Control, zeros: np.ndarray, places: Listed) -> None:
    last = int(zeros[1]) if len(zeros) else control.NRS
    card, place = places.places[last]
    cursor.findings.error(
        "MD108",
        f"{len(zeros) or 'none'} of the NRS+1 = {control.NRS + 1} pairs are 0 0; expected one "
        f"({cursor.place(card, place, RS)})",
        cursor.images.span(card, place.column, 2 * place.width),
        "one pair 0 0 separates the stiffness elements from the mass elements; without mass elements it comes last",
        "give NRS pairs and one pair 0 0, or mend NRS on the control card",
    )


def read_indic(cursor: Cursor, control: Control) -> Listed:
    """Group 5: cards of twenty until a 20th value is zero, or seven cards (more where IROW needs them)."""
    errors = cursor.findings.errors
    listed, most = Listed(cursor), max(MOST_INDIC_CARDS, INDIC.cards_for(control.IROW))
    for number in range(most):
        start = number * len(INDIC.fields)
        card = cursor.take(INDIC, start)
        _indic_card(cursor, control, card, start, listed)
        if not cursor.images.cards[card][-INDIC.fields[-1].width :].strip(" 0") and not _kept(cursor, start):
            break
    if cursor.findings.errors == errors:
        _check_indic(cursor, control, listed)
    return listed


def _kept(cursor: Cursor, start: int) -> bool:
    """Whether the 20th value of a card is given by an override."""
    return bool(cursor.overrides.get(INDIC.fields[-1].label(start + len(INDIC.fields))))


def _indic_card(cursor: Cursor, control: Control, card: int, start: int, listed: Listed) -> None:
    """One card of positions; when all IROW are known, it must be blank."""
    if start and start >= control.IROW and cursor.images.cards[card].strip(" 0"):
        cursor.findings.stop(
            "MD109",
            f"INDIC has its IROW = {control.IROW} positions, and the 20th value of its last card is not 0: "
            "a blank card "
            f"must follow (card {card + 1}, {INDIC.title})",
            cursor.images.span(card),
            "a card of INDIC is followed by another as long as its 20th value is not zero",
            f"insert a blank card before card {card + 1}",
        )
    used = INDIC.fields[: max(0, control.IROW - start)]
    for k, place in enumerate(used, start + 1):
        listed.add(cursor.value(card, place, k, INDIC), card, place, 0)
    note = f"IROW = {control.IROW} positions are expected"
    cursor.refuse_used(card, INDIC, INDIC.fields[len(used) :], note)


def _check_indic(cursor: Cursor, control: Control, listed: Listed) -> None:
    """IROW nonzero positions, none missing."""
    found = sum(1 for value in listed.values if value)
    if found == control.IROW:
        return
    at = next((i for i, value in enumerate(listed.values) if not value), len(listed.values) - 1)
    cursor.findings.error(
        "MD109",
        f"INDIC holds {found} positions, but IROW = {control.IROW} ({cursor.place(*listed.places[at], INDIC)})",
        listed.where(at),
        "the list ends at a card whose 20th value (columns 77-80) is 0",
        "punch one position in each field, without gaps, or mend IROW on the control card",
    )
