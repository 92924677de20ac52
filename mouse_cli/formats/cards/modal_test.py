"""The modal test of a card deck: groups 3, 5, 8, 9 and 10 put together, with the readings that the manual
leaves open.

The manual does not say whether the row of X is a degree of freedom or a position in INDIC, nor whether its
column is a position in MODE or a system mode number. The first of each is meant unless the deck can only be
read the other way.
"""

import numpy as np

from mouse_cli._span import Span
from mouse_cli.formats.cards.control import Control
from mouse_cli.formats.cards.cursor import Cursor
from mouse_cli.formats.cards.input import Matrix, slot_span
from mouse_cli.formats.cards.layout import X
from mouse_cli.formats.cards.lists import Listed
from mouse_cli.formats.draft import TestDraft

Places = dict[tuple[int, int], tuple[int, int]]


def test_draft(
    cursor: Cursor,
    control: Control,
    modes: Listed,
    indic: Listed,
    lamtst: Listed,
    matrix: Matrix,
    var: Listed,
) -> TestDraft:
    """Shapes (s, m) from X, their standard deviations from VAR; what is not punched is a measured zero."""
    shapes, places = _shapes(cursor, control, modes, indic, matrix)
    end = cursor.images.span(matrix.end)
    nm, irow = control.NM, control.IROW
    sd = np.array(var.values[nm:], dtype=float).reshape(nm, irow).T
    return TestDraft(
        number=np.array(modes.values, dtype=np.int64),
        frequency_hz=np.array(lamtst.values, dtype=float),
        frequency_sd_hz=np.array(var.values[:nm], dtype=float),
        dofs=np.array(indic.values, dtype=np.int64),
        shapes=shapes,
        shape_sd=sd,
        where_number=modes.where,
        where_frequency=lamtst.where,
        where_frequency_sd=var.where,
        where_dof=indic.where,
        where_shape=lambda s, m: slot_span(cursor, X, *places[s, m]) if (s, m) in places else end,
        where_shape_sd=lambda s, m: var.where(nm + m * irow + s),
    )


test_draft.__test__ = False  # not a pytest function


def _shapes(
    cursor: Cursor, control: Control, modes: Listed, indic: Listed, matrix: Matrix
) -> tuple[np.ndarray, Places]:
    """X by position in INDIC and in MODE, with the place of each element."""
    rows = _row_positions(cursor, control, indic, matrix)
    cols = _column_positions(cursor, control, modes, matrix)
    shapes, places = np.zeros((control.IROW, control.NM)), {}
    for (i, j), (value, card, slot) in matrix.elements.items():
        if i in rows and j in cols:
            shapes[rows[i], cols[j]] = value
            places[rows[i], cols[j]] = card, slot
        elif i not in rows and cols:
            _refuse_row(cursor, card, slot, i, j)
    if cols:
        _warn_of_unpunched(cursor, control, indic, places, cursor.images.span(matrix.end))
    return shapes, places


def _row_positions(cursor: Cursor, control: Control, indic: Listed, matrix: Matrix) -> dict[int, int]:
    """Position of each row index: degrees of freedom, unless only positions 1 to IROW make sense."""
    used = {i for i, _ in matrix.elements}
    dofs = {int(dof): k for k, dof in enumerate(indic.values)}
    positions = {k: k - 1 for k in range(1, control.IROW + 1)}
    if not used <= positions.keys() or dofs == positions:
        return dofs
    if used <= dofs.keys():
        _warn_of_rows(cursor, matrix, "degrees of freedom", "they could also be positions in INDIC")
        return dofs
    _warn_of_rows(cursor, matrix, "positions in INDIC", "some are no degree of freedom of INDIC")
    return positions


def _warn_of_rows(cursor: Cursor, matrix: Matrix, taken: str, why: str) -> None:
    """Say how the rows of X were read where the manual leaves it open."""
    if matrix.elements:
        _, card, slot = next(iter(matrix.elements.values()))
        cursor.findings.warn(
            "MD117",
            f"the row indices of X are taken as {taken}: {why} ({X.title})",
            slot_span(cursor, X, card, slot),
            "INDIC is the location of the data in the test eigenvector",
            "punch the degree of freedom, as in INDIC, in the row field of X",
        )


def _column_positions(cursor: Cursor, control: Control, modes: Listed, matrix: Matrix) -> dict[int, int]:
    """Position of each column index: 1 to NM, unless all are system mode numbers; empty after an error."""
    positions = {k: k - 1 for k in range(1, control.NM + 1)}
    used = {j for _, j in matrix.elements}
    if used <= positions.keys():
        return positions
    if used <= set(modes.values):
        _warn_of_columns(cursor, matrix)
        return {int(mode): k for k, mode in enumerate(modes.values)}
    _refuse_columns(cursor, control, matrix)
    return {}


def _warn_of_columns(cursor: Cursor, matrix: Matrix) -> None:
    _, card, slot = next(iter(matrix.elements.values()))
    cursor.findings.warn(
        "MD118",
        f"the column indices of X are taken as system mode numbers, as in MODE ({X.title})",
        slot_span(cursor, X, card, slot),
        "some are above NM, and all are in MODE",
        "punch the position of the mode in MODE, from 1 to NM",
    )


def _refuse_columns(cursor: Cursor, control: Control, matrix: Matrix) -> None:
    """Columns beyond NM: perhaps rows and columns were exchanged."""
    exchanged = all(i <= control.NM for i, _ in matrix.elements)
    for (i, j), (_, card, slot) in matrix.elements.items():
        if j > control.NM:
            cursor.findings.error(
                "MD118",
                f"X({i},{j}) is in column {j}, but there are NM = {control.NM} measured modes "
                f"(card {card + 1}, {X.title})",
                slot_span(cursor, X, card, slot),
                "all rows are within NM: X looks transposed" if exchanged else "the column is the position in MODE",
                "punch the degree of freedom first, then the mode"
                if exchanged
                else f"give a column from 1 to {control.NM}",
            )
        if exchanged and j > control.NM:
            return


def _refuse_row(cursor: Cursor, card: int, slot: int, i: int, j: int) -> None:
    cursor.findings.error(
        "MD119",
        f"X({i},{j}) is at degree of freedom {i}, which is not in INDIC (card {card + 1}, {X.title})",
        slot_span(cursor, X, card, slot),
        "the test eigenvectors are known at the degrees of freedom of INDIC only",
        f"add {i} to INDIC, or delete the element",
    )


def _warn_of_unpunched(cursor: Cursor, control: Control, indic: Listed, places: Places, end: Span) -> None:
    for m in range(control.NM):
        for s in range(control.IROW):
            if (s, m) not in places:
                cursor.findings.warn(
                    "MD113",
                    f"X({indic.values[s]},{m + 1}) is not punched and counts as a measured zero ({X.title})",
                    end,
                    "a card deck has no mark for a missing datum",
                    "punch the element, 0. if it was measured as zero",
                )
