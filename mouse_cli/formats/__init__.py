"""Decks in and out: the format is recognised by the content, and only the reader that is needed is loaded."""

import os
import re
from typing import BinaryIO

from mouse_cli._errors import DeckError
from mouse_cli._span import Span
from mouse_cli.formats.draft import Draft
from mouse_cli.model.problem import Problem

MAX_BYTES = 500_000_000  # of a deck of cards or of YAML, and of a document of results
_YAML_SUFFIXES = (".yaml", ".yml")
_VERSION_KEY = re.compile(r"""^["']?mouse["']?\s*:""")
_OTHERS = re.compile(rb"^(couple|modify)[ \t]*:", re.MULTILINE)
_LEADING_LINES = 50  # a deck in YAML says `mouse: 1` at its head, below comments at most


def read_deck(path: str | os.PathLike[str], *, legacy: bool = False, **options: object) -> Problem:
    """The problem that a deck in either format states; `options` are those of `read_draft`.

    Raises DeckError with everything that is wrong with the deck.

    >>> import mouse_cli
    >>> problem = mouse_cli.read_deck("decks/sound_chain.yaml")
    >>> [parameter.name for parameter in problem.parameters], float(problem.test.frequency_hz[0])
    (['k1', 'k2', 'k3', 'k4'], 1.77159)
    """
    from mouse_cli.formats.assemble import assemble

    return assemble(read_draft(file_bytes(os.fspath(path)), os.fspath(path), legacy=legacy, **options))


def read_draft(
    data: str | bytes, path: str, *, legacy: bool = False, outside: bool = False, **options: object
) -> Draft:
    """A deck as written. `options` (strip_73_80, overrides) concern card decks alone.

    outside: a YAML deck may name files outside of its own folder.

    Raises DeckError when the text cannot be read as a deck.
    """
    if is_yaml(data, path):
        from mouse_cli.formats import yaml_deck

        draft = yaml_deck.read(data, path, outside)
        return draft.with_run(legacy=True) if legacy else draft
    from mouse_cli.formats import cards

    return cards.read(data, path, legacy=legacy, **options)


def write_deck(problem: Problem, path: str | os.PathLike[str]) -> list[str]:
    """Write the problem as YAML, large matrices and tables beside it; returns the names of all files, the deck last.

    Raises WrittenError.

    >>> import mouse_cli, tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     files = mouse_cli.write_deck(mouse_cli.read_deck("decks/table_5_2.dat"), f"{folder}/chain.yaml")
    ...     print(len(files), len(mouse_cli.read_deck(files[-1]).parameters))
    1 2
    """
    from mouse_cli._atomic import write_text_atomically
    from mouse_cli.formats import yaml_deck
    from mouse_cli.formats.matrix_files import market

    path = os.fspath(path)
    folder, name = os.path.split(path)
    text, attachments = yaml_deck.write(problem, os.path.splitext(name)[0], folder)
    written = []
    for attachment, matrix in attachments.items():  # before the deck: it must not name files that are not there
        written.append(os.path.join(folder, attachment))
        text_of = matrix if isinstance(matrix, str) else market.text(matrix, problem.title)
        write_text_atomically(written[-1], text_of)
    write_text_atomically(path, text)
    return [*written, path]


def check_folder(problem: Problem, folder: str) -> None:
    """Raises WrittenError where a deck of the problem could not be written to a folder: its recordings are not below it."""
    from mouse_cli.formats.yaml_deck.writer_tests import test_lines

    test_lines(problem, folder)


def is_yaml(data: str | bytes, path: str = "") -> bool:
    """Whether a deck is in YAML: by its suffix, or by a line `mouse:` before any other key."""
    if path.lower().endswith(_YAML_SUFFIXES):
        return True
    head = data[:20_000]
    text = head.decode("utf-8", "replace") if isinstance(head, bytes) else head
    lines = [
        line
        for line in text.removeprefix("\ufeff").splitlines()
        if line.strip() and not line.startswith(("#", "%", "---"))
    ]
    return any(_VERSION_KEY.match(line) for line in lines[:_LEADING_LINES])


def holds(data: str | bytes, path: str = "") -> str:
    """What a deck holds instead of a model: `couple` or `modify`; `model` for all others."""
    found = (
        _OTHERS.search(data.encode("utf-8", "replace") if isinstance(data, str) else data)
        if is_yaml(data, path)
        else None
    )
    return found[1].decode() if found else "model"


def file_bytes(path: str) -> bytes:
    """Content of the file `path`, a pipe too. Raises DeckError when it cannot be read, or does not end."""
    try:
        with open(path, "rb") as stream:
            return bounded(stream, path)
    except OSError as error:
        message = f"the deck cannot be read: {error.strerror or error}"
        raise DeckError.of("MD250", message, Span(path, 1), help="check the name of the file") from error


def bounded(stream: BinaryIO, path: str) -> bytes:
    """What `stream` holds; of an endless one no more than any deck has. Raises DeckError (MD202)."""
    data = stream.read(MAX_BYTES + 1)
    if len(data) > MAX_BYTES:
        message = f"the file has more than {MAX_BYTES} bytes; no more are read of a deck or a result"
        help = "put large matrices in files: {file: k.mtx}"
        raise DeckError.of("MD202", message, Span(path, 1), help=help)
    return data
