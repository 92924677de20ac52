"""A job: one deck, what is asked of it, and the hash by which an answer that is there already is known again."""

import hashlib
import json
import os
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass, field, replace
from typing import Any

from mouse_cli import __version__
from mouse_cli._errors import DeckError
from mouse_cli.batch.expectation import Expectation
from mouse_cli.formats import below, is_yaml

RUN, CHECK, DIAGNOSE = "run", "check", "diagnose"
_DIGITS = 12  # of the hash in the name of a result
_STEM = 60  # characters of the deck's name in it


@dataclass(frozen=True)
class Job:
    """`command` on the deck at the path `deck`, with `options` that replace those of its `run:`; expectations of the answer.

    outside: the deck may name files outside of its own folder.
    """

    deck: str
    command: str = RUN
    options: dict[str, Any] = field(default_factory=dict)
    expected: tuple[Expectation, ...] = ()
    outside: bool = False

    def result(self, folder: str) -> str:
        """Path of the file below `folder` that holds the answer: one for each deck, command and set of options."""
        place = os.path.relpath(os.path.realpath(self.deck), os.path.realpath(folder))
        asked = hashlib.sha256(os.fsencode(f"{place}\0{self._asked()}")).hexdigest()
        stem = os.path.splitext(os.path.basename(self.deck))[0][:_STEM]
        return os.path.join(folder, f"{stem}-{asked[:_DIGITS]}.json")

    def identity(self, data: bytes) -> str:
        """Hash of all that the answer depends on: the deck's content `data`, files that it names, what is asked, the version."""
        allowed = "outside\0" if self.outside else ""
        whole = hashlib.sha256(f"{__version__}\0{self._asked()}\0{allowed}".encode())
        whole.update(hashlib.sha256(data).digest())
        for path in named_files(data, self.deck, self.outside):
            whole.update(os.fsencode(f"\0{os.path.basename(path)}\0"))
            with open(path, "rb") as stream:
                whole.update(hashlib.file_digest(stream, "sha256").digest())
        return whole.hexdigest()

    def _asked(self) -> str:
        return json.dumps([self.command, self.options], sort_keys=True)


def named_files(data: bytes, path: str, outside: bool = False) -> list[str]:
    """Files that the deck `path` of the content `data` may name and does, sorted."""
    if not is_yaml(data, path) or b"file" not in data:  # every key of a deck that names a file is called so
        return []
    from mouse_cli.formats.yaml_deck.nodes import compose

    try:
        _, root = compose(data, path)
    except DeckError:  # the job will tell of it
        return []
    places = set()
    for name in _names(root):
        with suppress(below.Refused):
            places.add(below.named(os.path.dirname(path), name, outside))
    return sorted(place for place in places if os.path.isfile(place))


def _names(root: object) -> Iterator[str]:
    """Texts below a node that may name a file. A node that aliases repeat is visited once."""
    waiting, seen = [root], set()
    while waiting:
        node = waiting.pop()
        if id(node) in seen:
            continue
        seen.add(id(node))
        if isinstance(node, tuple):  # key and value
            waiting += node
        elif isinstance(node.value, list):
            waiting += node.value
        elif 0 < len(node.value) < 1000 and "\0" not in node.value and not _is_number(node.value):
            yield node.value


def _is_number(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return True


def once(jobs: list[Job]) -> list[Job]:
    """`jobs` without those that ask the same of the same deck again; their expectations go to the first."""
    kept: dict[tuple[str, str], Job] = {}
    for job in jobs:
        key = (os.path.realpath(job.deck), job._asked())
        first = kept.get(key)
        kept[key] = job if first is None else replace(first, expected=first.expected + job.expected)
    return list(kept.values())
