"""Data sets of a universal file, ASCII and binary, told apart without trust in what instruments write between them."""

import re
from bisect import bisect_left
from collections.abc import Iterator
from dataclasses import dataclass

from mouse_cli.formats.data_files import decoded

_MARK = re.compile(rb"(?:^|(?<=\n)|(?<=\r))[ \t]*-1[ \t]*(?:\r\n|\n|\r|$)")
_HEAD = re.compile(rb"[ \t]*([0-9]+)([bB]?)([^\r\n]*)(?:\r\n|\n|\r|$)")
_LINE = re.compile(rb"([^\r\n]*)(?:\r\n|\n|\r|$)")


@dataclass(frozen=True)
class Block:
    """One data set. number: 58, 164, ...; binary: of `58b`; extra: what its first line says after that.

    at: byte at which its content begins; content: up to the mark that ends it, for a binary one far enough.
    """

    number: int
    binary: bool
    extra: str
    at: int
    content: memoryview


def blocks(data: bytes) -> Iterator[Block]:
    """Every data set that begins in `data`, binary ones by their length."""
    view, at = memoryview(data), 0
    marks = [mark.span() for mark in _MARK.finditer(data)]
    closing = [mark for mark in marks if _closes(data, mark[1])]
    for begun, after in marks:
        if begun < at:
            continue
        head = _HEAD.match(data, after)
        if head is None:
            at = after
            continue
        begin, extra = head.end(), head[3].decode("latin-1")
        binary = bool(head[2]) or (head[1] == b"58" and extra.strip()[:1].lower() == "b")
        least = begin + (_binary_bytes(data, begin, extra) if binary else 0)
        end = _end(data, least, closing)
        yield Block(int(head[1]), binary, extra, begin, view[begin : end[0]])
        at = end[1]


def _binary_bytes(data: bytes, begin: int, extra: str) -> int:
    """Bytes that the eleven lines of the head and the numbers take at least; by the head, since programs promise too few."""
    fields = [int(word) for word in extra.split() if word.isdecimal()]
    head, at = lines(data, begin, 11)
    counts = head[6].split()[:3]
    least = fields[3] if len(fields) > 3 else 0
    if len(counts) == 3 and all(word.isdecimal() for word in counts):
        kind, count, even = (int(word) for word in counts)
        least = count * ((8 if kind in (4, 6) else 4) * (2 if kind in (5, 6) else 1) + (0 if even else 4))
    return min(at - begin + least, len(data) - begin)


def lines(data: bytes | memoryview, at: int, count: int) -> tuple[list[str], int]:
    """So many lines from byte `at`, and the byte after them."""
    found = []
    for _ in range(count):
        line = _LINE.match(data, at)
        found.append(decoded(bytes(line[1])))
        at = line.end()
    return found, at


def _end(data: bytes, at: int, closing: list[tuple[int, int]]) -> tuple[int, int]:
    """Where the content ends, and where the search for the next data set goes on: after the mark that ends it."""
    place = bisect_left(closing, (at, at))
    if place < len(closing):
        return closing[place]
    # binary data may end without a line end before the mark
    close = data.find(b"    -1", at)
    return (close, close + 6) if close >= 0 else (len(data), len(data))


def _closes(data: bytes, after: int) -> bool:
    """Whether a mark that ends at byte `after` may end a data set: the end of the file, another mark or no number follows.

    A mark inside is a number of the data set, -1 alone in its line.
    """
    text = data[after : after + 400].lstrip()
    return not text or text.startswith(b"-1") or text[:1] not in b"0123456789+-."
