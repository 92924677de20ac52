"""Tables of nodes and elements beside a deck: a line of numbers each, separated by commas, with or without a head."""

from dataclasses import dataclass

import numpy as np

from mouse_cli.formats.data_files import line_span, reject, text_lines

_MOST = 5_000_000  # lines


@dataclass
class NumberTable:
    """head: names of the columns (empty: none were given); values (lines, columns)."""

    head: tuple[str, ...]
    values: np.ndarray


def read_table(path: str, least: int) -> NumberTable:
    """The table in the file `path`, of at least so many columns; lines that are empty or begin with # are passed over.

    Raises DeckError (MD250, MD419) that names the line that is no row of numbers.
    """
    lines = _lines(path)
    kept = [i for i, line in enumerate(lines) if line.strip() and not line.lstrip().startswith("#")]
    head: tuple[str, ...] = ()
    if kept and any(_number(cell) is None for cell in lines[kept[0]].split(",")):
        head, kept = tuple(cell.strip() for cell in lines[kept[0]].split(",")), kept[1:]
    if not kept or len(kept) > _MOST:
        reject("MD419", path, f"the table has {len(kept)} rows", f"give 1 to {_MOST} lines of numbers")
    width = len(head) or len(lines[kept[0]].split(","))
    if width < least:
        reject("MD419", path, f"the table has {width} columns; expected at least {least}", "separate numbers by commas")
    return NumberTable(head, _values(path, lines, kept, width))


def _lines(path: str) -> list[str]:
    try:
        return text_lines(path)
    except OSError as error:
        message = f"the file cannot be read: {error.strerror}"
        reject("MD250", path, message, "check the name; paths are relative to the deck")


def _values(path: str, lines: list[str], kept: list[int], width: int) -> np.ndarray:
    try:
        cells = ",".join([lines[i] for i in kept]).split(",")
        values = np.array(cells, float)
        if len(values) == len(kept) * width and all(lines[i].count(",") == width - 1 for i in kept):
            return values.reshape(len(kept), width)
    except ValueError:
        pass
    for i in kept:
        cells = lines[i].split(",")
        wrong = next((cell for cell in cells if _number(cell) is None), None)
        if wrong is not None or len(cells) != width:
            message = (
                f"'{wrong.strip()[:40]}' is no number" if wrong is not None else f"the line has {len(cells)} values"
            )
            span = line_span(path, i + 1, lines[i], wrong or "")
            reject("MD419", path, message, f"give {width} numbers, separated by commas", span)
    raise AssertionError("a table that cannot be read has a line that is wrong")


def _number(cell: str) -> float | None:
    try:
        return float(cell)
    except ValueError:
        return None
