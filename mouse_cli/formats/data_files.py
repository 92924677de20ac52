"""Files beside a deck, of whatever format: found, told from what they are not, and matched to a reader."""

import errno
import os
import warnings
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, NoReturn

import numpy as np

from mouse_cli import _registry
from mouse_cli._errors import DeckError
from mouse_cli._span import Span
from mouse_cli.dynamics import memory

_LARGEST = 2**31 - 1  # number of a node or a row
_SHARE = 2  # one file may take one in so many parts of the memory
_LINES = 12  # times the size of a text file that its lines and numbers take at most while they are read
_LONGEST = 600  # characters of a message
_WIDEST = 200  # characters of a line that a diagnostic shows
_DISGUISES = (  # how files begin that are not what their name says
    (b"<!doctype html", "an HTML page, such as a server sends instead of a file", "fetch the file itself"),
    (b"<html", "an HTML page, such as a server sends instead of a file", "fetch the file itself"),
    (b"<?xml", "an XML file", "export the matrix in one of the formats that are read"),
    (b"\x89png", "a picture (PNG)", "give the file of the matrix, not a plot of it"),
    (b"%pdf", "a PDF document", "give the file that the document was made from"),
    (b"\xd0\xcf\x11\xe0", "a workbook of Excel", "export it as .csv"),
    (b"pk\x03\x04", "a zip archive, or a workbook of Excel", "unpack it, or export the workbook as .csv"),
    (b"\x1f\x8b", "compressed by gzip", "unpack it"),
    (b"version https://git-lfs", "a pointer of Git LFS, not the file", "fetch the file: git lfs pull"),
)


@dataclass(frozen=True, slots=True)
class FileFormat:
    """A format of files of one kind: read(path) gives what the folder of that kind says.

    suffixes: of its files, without the point; default: `key`. claims(head): whether a file that begins with these bytes is of this
    format, where several share a suffix. named: whether a file may hold several things, and read(path, variable) is told which.
    """

    key: str
    read: Callable[..., Any]
    suffixes: tuple[str, ...] = ()
    claims: Callable[[bytes], bool] | None = None
    named: bool = False


def reject(code: str, path: str, message: str, help: str = "", span: Span | None = None) -> NoReturn:
    """Raise the DeckError of one finding; names and shapes that damage has made endless are cut."""
    message = message if len(message) <= _LONGEST else f"{message[:_LONGEST]}..."
    raise DeckError.of(code, message, span or Span(path, 1), help=help)


def check_memory(
    path: str, needed: int, what: str = "the file", help: str = "divide the file, or take a machine with more"
) -> None:
    """Refuse (MD258) what would take more than half of the memory that there is, before any of it is taken.

    A file that is not packed cannot promise more than its own size; one that is packed may unpack to anything.
    """
    most = memory.available() // _SHARE
    if needed > most:
        message = f"{what} takes {memory.shown(needed)} of memory; at most {memory.shown(most)}, half of what there is, are given"
        reject("MD258", path, message, help)


def kept(path: str, promised: int, what: str) -> None:
    """Refuse (MD252) a head that promises more bytes than the whole file has."""
    held = os.path.getsize(path)
    if promised > held:
        message = f"{what} takes {promised} bytes, and the whole file has {held}"
        reject("MD252", path, message, "the file is cut short, or its head is wrong: write it again")


def line_span(path: str, number: int, line: str, part: str = "") -> Span:
    """Place of line `number` (from 1) of a text file, or of `part` of it."""
    shown = line.rstrip("\r\n")[:_WIDEST]
    column = shown.find(part) + 1 if part else 0
    return Span(path, number, max(1, column), max(1, len(part) if column else len(shown)), shown)


def reader(package: str, path: str, what: str) -> FileFormat:
    """The format of `package` that reads the file `path`: by its suffix, and by its first bytes where formats share one.

    Raises DeckError (MD250, MD251, MD252, MD258) when there is no such file, or none of the formats is its.
    """
    existing(path)
    suffix = os.path.splitext(path)[1].lower().removeprefix(".")
    formats = _registry.discover(package, "FORMAT").values()
    own = [each for each in formats if suffix in (each.suffixes or (each.key,))]
    if not own:
        known = ", ".join(sorted({f".{s}" for each in formats for s in each.suffixes or (each.key,)}))
        reject("MD251", path, f"'.{suffix}' is no suffix of {what}", f"give one of {known}")
    head = _head(path)
    claiming = [each for each in own if each.claims is not None and each.claims(head)]
    _undisguised(path, head, suffix)
    return (claiming or [each for each in own if each.claims is None] or own)[0]


def opened(form: FileFormat, path: str, *arguments: object) -> Any:
    """What `form.read(path, *arguments)` gives.

    Raises DeckError: MD250 where the system refuses the file, MD252 where it is damaged, MD258 where memory does not suffice.
    """
    try:
        with (
            np.errstate(all="ignore"),
            warnings.catch_warnings(),
        ):  # what numbers are no numbers is told by those who use them
            warnings.simplefilter("ignore")
            return form.read(path, *arguments)
    except DeckError:
        raise
    except MemoryError:
        reject(
            "MD258", path, "the file takes more memory than there is", "divide the file, or take a machine with more"
        )
    except OSError as error:
        if error.errno in (None, errno.EINVAL):  # of h5py on damage, of places in a file that cannot be
            _damaged(form, path, error)
        reject("MD250", path, f"the file cannot be read: {error}", "check the file and its permissions")
    except Exception as error:  # readers of damaged files, NumPy's and SciPy's too, raise whatever their parts do
        _damaged(form, path, error)


def _damaged(form: FileFormat, path: str, error: Exception) -> NoReturn:
    what = str(error).split("\n")[0][:200] or type(error).__name__
    reject("MD252", path, f"damaged, or not of the format '{form.key}': {what}", "write the file again")


def rows_of(package: str, path: str, what: str, nothing: str, help: str) -> Any:
    """What the format of `package` reads of the file `path`. Raises DeckError (MD250 to MD262), also where that is nothing."""
    rows = opened(reader(package, path, what), path)
    if not rows:
        reject("MD252", path, nothing, help)
    return rows


def text_lines(path: str, encoding: str = "latin-1", errors: str = "strict") -> list[str]:
    """Lines of a text file, without their ends; bytes beyond ASCII stand for themselves, for the reader to refuse."""
    check_memory(path, _LINES * os.path.getsize(path))
    with open(path, encoding=encoding, errors=errors, newline=None) as stream:
        return stream.read().split("\n")


def decoded(data: bytes) -> str:
    """UTF-8 when it is, so that one character is one column; else one column a byte."""
    try:
        return data.decode("utf-8")
    except UnicodeDecodeError:
        return data.decode("latin-1")


def natural(word: str) -> int:
    """The number of a node or of a row that a word spells, from 1; 0 where it spells none."""
    number = int(word) if word.isascii() and word.isdigit() and len(word) < 13 else 0
    return number if number <= _LARGEST else 0


def existing(path: str) -> None:
    """Raise DeckError (MD250) where a path is no file, or one too large for the memory."""
    if not os.path.exists(path):
        reject("MD250", path, "there is no such file", "check the name; paths are relative to the deck")
    if not os.path.isfile(path):
        reject("MD250", path, "this is not a file", "give the name of a file")
    check_memory(path, os.path.getsize(path))


def _head(path: str) -> bytes:
    try:
        with open(path, "rb") as stream:
            return stream.read(4096)
    except OSError as error:
        reject("MD250", path, f"the file cannot be read: {error}", "check the file and its permissions")


def _undisguised(path: str, head: bytes, suffix: str) -> None:
    if not head:
        reject("MD252", path, "the file is empty", "write it again")
    start = head.removeprefix(b"\xef\xbb\xbf").lstrip().lower()
    for mark, what, remedy in _DISGUISES:
        if start.startswith(mark) and not (suffix == "npz" and mark.startswith(b"pk")):
            reject("MD252", path, f"the file is {what}", remedy)
