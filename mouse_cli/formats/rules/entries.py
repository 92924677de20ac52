"""Rules for any list of matrix elements: indices within the matrix, values finite."""

import numpy as np

from mouse_cli.formats.draft import Draft, Entries

MOST = 20  # findings of one list that are reported one by one
LARGEST = 1e150  # of a value: products of larger ones are beyond all floating-point numbers


def inside(draft: Draft, entries: Entries, rows: int, cols: int, what: str) -> np.ndarray:
    """Mask of the entries within (rows, cols), after noting MD301 for each that is not."""
    found = (entries.rows >= 1) & (entries.rows <= rows) & (entries.cols >= 1) & (entries.cols <= cols)
    for i in np.flatnonzero(~found)[:MOST]:
        message = f"{what} ({entries.rows[i]},{entries.cols[i]}) is outside {rows} x {cols}"
        draft.error(
            "MD301", message, entries.where(int(i)), help=f"give a row from 1 to {rows} and a column from 1 to {cols}"
        )
    return found


def finite(draft: Draft, entries: Entries, name: str) -> None:
    """Note MD302 for each value that is infinite, not a number, or larger than any of which products can be made."""
    for i in np.flatnonzero(~(np.abs(entries.values) < LARGEST))[:MOST]:
        message = (
            f"{name}({entries.rows[i]},{entries.cols[i]}) is {entries.values[i]}, not a finite number below {LARGEST:g}"
        )
        draft.error("MD302", message, entries.where(int(i)), help="give a finite number")
