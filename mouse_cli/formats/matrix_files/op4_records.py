"""The records of an OUTPUT4 file: for each matrix its header and its strings, runs of values down a column."""

import re
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

Strings = list[tuple[int, int, np.ndarray]]  # row and column of the first value, from 0, and the values
_FORMAT = re.compile(r"(\d+)[ED](\d+)\.\d+")
_BIGMAT_ROWS = 65536  # matrices with so many rows are BIGMAT whatever their header says


class Damaged(Exception):
    """What contradicts the format; `line` (from 1) and `text` of a text file, 0 of a binary one."""

    def __init__(self, message: str, line: int = 0, text: str = ""):
        super().__init__(message)
        self.line, self.text = line, text


@dataclass(frozen=True)
class Header:
    """type: 1 single, 2 double precision, 3 and 4 complex. bigmat: whether sparse columns have two-word string headers."""

    name: str
    rows: int
    columns: int
    type: int
    bigmat: bool

    @property
    def parts(self) -> int:
        """Numbers that make one value."""
        return 2 if self.type > 2 else 1


def _header(columns: int, rows: int, type: int, name: str, line: int = 0, text: str = "") -> Header:
    name = name.replace("\0", "").replace(" ", "")  # with words of 8 bytes, blanks stand within
    if type not in (1, 2, 3, 4) or not name.isprintable() or columns < 0:
        raise Damaged(f"no header of a matrix: {columns} columns, type {type}, name '{name[:8]}'", line, text)
    return Header(name, abs(rows), columns, type, rows < 0 or abs(rows) >= _BIGMAT_ROWS)


def _string(header: Header, words: list[int], wordsize: int) -> tuple[int, int, int]:
    """Row (from 0) and number of values of a string, and the words it takes with its own header, which are `words`."""
    if header.bigmat:
        length, row = words[0] - 1, words[1]
    else:
        length, row = (words[0] >> 16) - 1, words[0] & 0xFFFF
    if length < 1 or row < 1 or length % (wordsize * header.parts):
        raise Damaged(f"a string of {length} words at row {row}")
    return row - 1, length // wordsize, length + len(words)


def binary_matrices(data: bytes) -> Iterator[tuple[Header, Strings]]:
    """Each matrix of a binary file: FORTRAN records of either byte order, words of 4 or 8 bytes."""
    order = next((o for o in "<>" if int.from_bytes(data[:4], "little" if o == "<" else "big") in (24, 48)), None)
    if order is None:
        raise Damaged("the first record is not a header of 24 or 48 bytes")
    records = _records(data, order)
    for record in records:
        word = len(record) // 6
        if len(record) not in (24, 48):
            raise Damaged(f"a header of {len(record)} bytes; expected 24 or 48")
        columns, rows, _, type = np.frombuffer(record, f"{order}i{word}", 4).tolist()
        header = _header(columns, rows, type, record[4 * word :].decode("latin-1"))
        yield header, _binary_columns(records, header, order, word)


def _records(data: bytes, order: str) -> Iterator[bytes]:
    """Payloads of FORTRAN records, each between two copies of its length."""
    at, end = 0, len(data)
    name = "little" if order == "<" else "big"
    while at + 8 <= end:
        length = int.from_bytes(data[at : at + 4], name)
        stop = at + 4 + length
        if stop + 4 > end or data[stop : stop + 4] != data[at : at + 4]:
            raise Damaged(f"the record at byte {at} is not whole")
        yield data[at + 4 : stop]
        at = stop + 4
    if at != end:
        raise Damaged(f"{end - at} bytes are left over")


def _binary_columns(records: Iterator[bytes], header: Header, order: str, word: int) -> Strings:
    single = header.type in (1, 3) and word == 4
    kind, size = (f"{order}f4", 1) if single else (f"{order}f8", 8 // word)
    found: Strings = []
    for record in records:
        if len(record) < 3 * word or len(record) % word:
            raise Damaged(f"a column of {len(record)} bytes")
        column, row, count = np.frombuffer(record, f"{order}i{word}", 3).tolist()
        if column > header.columns:
            return found
        if column < 1 or count < 0 or (3 + count) * word > len(record):
            raise Damaged(f"a record for column {column} of {header.columns} with {count} words")
        body = record[3 * word : (3 + count) * word]
        if row > 0:
            values = np.frombuffer(body[: len(body) // (size * word) * size * word], kind)
            found.append((row - 1, column - 1, values[:: header.parts].astype(float)))
        else:
            found += _binary_strings(body, header, column - 1, kind, size, word)
    raise Damaged(f"matrix {header.name} does not end")


def _binary_strings(body: bytes, header: Header, column: int, kind: str, size: int, word: int) -> Strings:
    found: Strings = []
    words = np.frombuffer(body, f"{kind[0]}i{word}")
    at, heads = 0, 2 if header.bigmat else 1
    while at + heads <= len(words):
        row, count, taken = _string(header, words[at : at + heads].tolist(), size)
        if at + taken > len(words):
            raise Damaged(f"a string of column {column + 1} is longer than its record")
        values = np.frombuffer(body, kind, count, (at + heads) * word)
        found.append((row, column, values[:: header.parts].astype(float)))
        at += taken
    return found


def text_matrices(data: bytes) -> Iterator[tuple[Header, Strings]]:
    """Each matrix of a text file."""
    lines = _Lines(data.decode("latin-1").splitlines())
    while lines.left and lines.peek().strip():
        line = lines.next()
        width = 16 if line.rstrip().endswith("|I16") else 8  # of the sizes alone: columns have 8 in any case
        line = line.rstrip().removesuffix("|I16")
        columns, rows = lines.numbers(line[: 2 * width], width, 2)
        _, type = lines.numbers(line[2 * width : 2 * width + 16], 8, 2)
        header = _header(columns, rows, type, line[2 * width + 16 : 2 * width + 24], lines.number, line)
        layout = _FORMAT.search(line[2 * width + 24 :].upper())
        perline, field = (int(x) for x in layout.groups()) if layout else (5, 16)
        if not 0 < perline * field <= 1000:
            raise lines.damage("no such format of numbers")
        yield header, _text_columns(lines, header, perline, field)


class _Lines:
    """Lines that are taken one after the other; `number` is that of the last one taken, from 1."""

    def __init__(self, lines: list[str]):
        self.lines, self.number = lines, 0

    @property
    def left(self) -> int:
        """Lines not yet taken."""
        return len(self.lines) - self.number

    def peek(self) -> str:
        """The next line, which stays."""
        return self.lines[self.number]

    def next(self) -> str:
        """The next line. Raises Damaged at the end of the file."""
        if not self.left:
            raise self.damage("the file ends within a matrix")
        self.number += 1
        return self.lines[self.number - 1]

    def damage(self, message: str) -> Damaged:
        """The error that names the line taken last."""
        return Damaged(message, max(1, self.number), self.lines[self.number - 1] if self.lines else "")

    def numbers(self, text: str, width: int, count: int) -> list[int]:
        """So many whole numbers of `width` characters each."""
        try:
            found = [int(text[i : i + width]) for i in range(0, len(text.rstrip()), width)]
        except ValueError:
            found = []
        if len(found) != count:
            raise self.damage(f"{count} whole numbers of {width} characters are expected")
        return found

    def values(self, count: int, perline: int, width: int) -> np.ndarray:
        """`count` numbers of `width` characters, `perline` on a line."""
        full, rest = divmod(count, perline)
        if full + bool(rest) > self.left:
            raise self.damage("the file ends within a column")
        found: list[str] = []
        for _ in range(full + bool(rest)):
            line = self.next()
            found += [line[i : i + width] for i in range(0, min(perline, count - len(found)) * width, width)]
        try:
            return np.array([float(x.replace("D", "E")) for x in found])
        except ValueError:
            raise self.damage(f"numbers of {width} characters are expected on the lines down to this one") from None


def _text_columns(lines: _Lines, header: Header, perline: int, field: int) -> Strings:
    found: Strings = []
    size = 1 if header.type in (1, 3) else 2
    heads = 2 if header.bigmat else 1
    while True:
        column, row, words = lines.numbers(lines.next(), 8, 3)
        if column > header.columns:
            lines.next()  # a closing value
            return found
        if column < 1 or words < 0:
            raise lines.damage(f"column {column} of {header.columns} with {words} words")
        if row > 0:
            found.append((row - 1, column - 1, lines.values(words, perline, field)[:: header.parts]))
            continue
        while words > 0:
            line = lines.next()
            string = lines.numbers(line, 8 if header.bigmat else max(1, len(line.rstrip())), heads)
            try:
                first, count, taken = _string(header, string, size)
            except Damaged as error:
                raise lines.damage(str(error)) from None
            found.append((first, column - 1, lines.values(count, perline, field)[:: header.parts]))
            words -= taken
