"""Decks behind a name: a file, a folder, or a pattern."""

import os
from collections.abc import Iterator
from glob import glob, has_magic

from mouse_cli._errors import ERROR, DeckError, Diagnostic
from mouse_cli._span import Span
from mouse_cli.formats import below, file_bytes, holds, is_yaml

_SUFFIXES = (".dat", ".yaml", ".yml")


def found(name: str, outside: bool = False) -> list[str]:
    """The decks that `name` stands for: itself, every model below a folder, or what a pattern (`**` too) matches; sorted.

    Raises DeckError (MD231, MD250) where a link in a folder leads out of it, unless `outside` is allowed, or to a pipe or device.
    """
    if os.path.isdir(name):
        paths = list(_below(name))
        wrong = [each for path in paths for each in refused(name, path, outside)]
        if wrong:
            raise DeckError(wrong)
        return [path for path in paths if _is_model(path)]
    if has_magic(name) and not os.path.exists(name):
        return sorted(path for path in glob(name, recursive=True) if os.path.isfile(path))
    return [name]


def refused(folder: str, path: str, outside: bool) -> list[Diagnostic]:
    """The finding that `path`, which a search of `folder` came upon, must not be read."""
    try:
        below.found(folder, path, outside, "that folder")
    except below.Refused as error:
        message = f"'{os.path.basename(path)}' was found in {folder}, {error}"
        return [Diagnostic(error.code, ERROR, message, Span(path, 1), help=error.help)]
    return []


def is_manifest(path: str) -> bool:
    """Whether a file is a manifest of jobs and no deck; a file that cannot be read is none."""
    import re

    try:
        data = file_bytes(path)
    except DeckError:
        return False
    return is_yaml(data, path) and re.search(rb"^batch[ \t]*:", data, re.MULTILINE) is not None


def _below(folder: str) -> Iterator[str]:
    for place, _, names in sorted(os.walk(folder)):
        yield from (os.path.join(place, name) for name in sorted(names) if name.endswith(_SUFFIXES))


def _is_model(path: str) -> bool:
    """Coupled structures, changes and manifests stand in the same folders; what cannot be read is told of by its job."""
    try:
        return holds(file_bytes(path), path) == "model" and not is_manifest(path)
    except DeckError:
        return True
