"""Recordings and frequency response functions of a Problem as YAML: they stay in their files, named as its deck names them."""

import os

from mouse_cli._errors import WrittenError
from mouse_cli.formats.yaml_deck import values as yaml_values
from mouse_cli.formats.yaml_deck.nodes import PLAIN, Node, compose, is_null
from mouse_cli.formats.yaml_deck.text import word, wrapped
from mouse_cli.model.problem import Problem

HELD_KEYS = ("recordings", "segments", "frf", "lines")


def measured(problem: Problem) -> bool:
    """Whether the problem has recordings or functions, used or kept from fits."""
    return bool(problem.frf or problem.recordings or problem.held_records)


class Written:
    """The `test:` of the deck that a problem was read from, as far as it names recordings and functions.

    folder: of the new deck; None: that of the old one. Raises WrittenError for data that no deck names, or that lie elsewhere.
    """

    def __init__(self, problem: Problem, folder: str | None = None):
        self.problem, self.folder, self.test = problem, folder, {}
        if not measured(problem):
            return
        if problem.source.format == "yaml" and problem.source.lines:
            _, root = compose("\n".join(problem.source.lines), problem.source.path)
            self.test = _keys(_keys(root).get("test"))
        if not ("frf" in self.test or "recordings" in self.test):
            message = "the measured data of the problem were read from no deck; a deck can only name their files"
            raise WrittenError.of("MD616", message, help="write them with `mouse spectra`, and name the file")

    def lines(self) -> list[str]:
        """The lines of `frf:` and `recordings:`."""
        found = []
        for key in ("frf", "recordings"):
            if key in self.test:
                found += [f"  {key}:", *(f"    - {self._rendered(item)}" for item in self.test[key].value)]
        return found

    def sensors(self, known: set[str]) -> list[str]:
        """Definitions of sensors whose names are not `known`."""
        node = self.test.get("sensors")
        found = [] if node is None else [(_keys(item), item) for item in node.value]
        return [self._rendered(item) for keys, item in found if keys["name"].value not in known]

    def held(self) -> list[str]:
        """Lines of `hold_out:` that concern them."""
        keys = _keys(self.test.get("hold_out"))
        return [
            f"    {key}: {self._rendered(keys[key], 4)}" for key in HELD_KEYS if key in keys and not is_null(keys[key])
        ]

    def _rendered(self, node: Node, indent: int = 6, key: str = "") -> str:
        """A value on one line, or on several where it is a long list."""
        if yaml_values.is_mapping(node):
            items = [f"{_scalar(k)}: {self._rendered(v, indent, k.value)}" for k, v in node.value if not is_null(v)]
            return f"{{{', '.join(items)}}}"
        if yaml_values.is_list(node):
            return wrapped([self._rendered(item, indent) for item in node.value], indent)
        return word(self._moved(node.value)) if key == "file" else _scalar(node)

    def _moved(self, name: str) -> str:
        """The name of a file as the new deck must give it."""
        old = os.path.dirname(os.path.abspath(self.problem.source.path))
        if self.folder is None or os.path.realpath(self.folder or ".") == os.path.realpath(old):
            return name
        new = os.path.relpath(os.path.join(old, name), self.folder or ".")
        if new.startswith(".."):
            message = f"the deck names '{name}', which would not be below the folder of the new deck"
            help = f"write the deck to {os.path.relpath(old)}, where its recordings are, or copy them first"
            raise WrittenError.of("MD617", message, help=help)
        return new


def _keys(node: Node | None) -> dict[str, Node]:
    """The keys of a mapping, with their nodes."""
    return {key.value: value for key, value in node.value} if node is not None and yaml_values.is_mapping(node) else {}


def _scalar(node: Node) -> str:
    """A number as it was written, anything else as a word."""
    number = node.tag == PLAIN and yaml_values.as_number(node) is not None
    return node.value if number else word(node.value)
