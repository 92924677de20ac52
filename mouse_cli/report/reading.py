"""Documents read again, for pages and figures: data, each value checked for its type where it is used."""

import json
from dataclasses import dataclass
from math import isfinite
from typing import Any

import numpy as np

from mouse_cli._errors import DeckError

ANSWERS = ("mouse.result/1", "mouse.diagnosis/1", "mouse.arrangements/1")  # of `mouse run` and `mouse diagnose`
_JOB = "mouse.job/1"  # of `mouse batch`; the answer stands in it
_KINDS = {dict: "an object", list: "a list", str: "a text", bool: "true or false", int: "a number", float: "a number"}


@dataclass(frozen=True)
class Part:
    """One object of a document; `place` is where it stands, such as `verdict.site`, and `file` what it was read from.

    Values that are absent or null are empty: "", None, [] or a Part without values. Raises DeckError (MD922) where a
    value is of another type than the document's schema says.
    """

    values: dict[str, Any]
    file: str
    place: str = ""

    def __bool__(self) -> bool:
        return bool(self.values)

    def text(self, key: str) -> str:
        """A text."""
        return self._of(key, (str,), "a text") or ""

    def label(self, key: str) -> str:
        """A text, or a number that stands for a name."""
        value = self._of(key, (str, int, float), "a text or a number")
        return "" if value is None else str(value)

    def labels(self, key: str) -> list[str]:
        """Names, texts or numbers."""
        return [each.label("") for each in self._items(key)]

    def texts(self, key: str) -> list[str]:
        """Sentences."""
        return [each.text("") for each in self._items(key)]

    def flag(self, key: str) -> bool:
        """Whether; False where it is not said."""
        return bool(self._of(key, (bool,), "true or false"))

    def number(self, key: str) -> float | None:
        """A number; None where it is unknown or beyond all numbers."""
        value = self._of(key, (int, float), "a number")
        if value is None or (isinstance(value, int) and abs(value) > 10**300):
            return None
        return float(value) if isfinite(value) else None

    def numbers(self, key: str) -> list[float | None]:
        """Numbers, None where one is unknown."""
        return [each.number("") for each in self._items(key)]

    def rows(self, key: str) -> list[list[float | None]]:
        """Lists of numbers, such as coordinates."""
        return [each.numbers("") for each in self._items(key)]

    def vectors(self, key: str, width: int | None = None) -> list[list[float]]:
        """Lists of numbers, `width` in each, none of them unknown."""
        found = self._list(key)
        for row in found:
            if not isinstance(row, list) or width not in (None, len(row)) or not all(map(_finite, row)):
                each = "numbers" if width is None else f"{width} numbers"
                raise rejected("MD922", f"{self.file}: {self._at(key)}[] is something else; expected lists of {each}")
        return found

    def part(self, key: str) -> "Part":
        """The object below `key`."""
        return Part(self._of(key, (dict,), "an object") or {}, self.file, self._at(key))

    def parts(self, key: str) -> list["Part"]:
        """The objects of the list below `key`."""
        return [each.part("") for each in self._items(key)]

    def _items(self, key: str) -> list["Part"]:
        """The items of the list below `key`, each below "" of a part of its own."""
        return [Part({"": value}, self.file, f"{self._at(key)}[]") for value in self._list(key)]

    def _list(self, key: str) -> list[Any]:
        return self._of(key, (list,), "a list") or []

    def _of(self, key: str, types: tuple[type, ...], expected: str) -> Any:
        value = self.values.get(key)
        if value is None or (isinstance(value, types) and (not isinstance(value, bool) or bool in types)):
            return value
        got = _KINDS.get(type(value), "something else")
        raise rejected("MD922", f"{self.file}: {self._at(key)} is {got}; expected {expected}")

    def _at(self, key: str) -> str:
        return ".".join(filter(None, (self.place, key)))


def read(data: bytes, file: str, schemas: tuple[str, ...] = ANSWERS) -> Part:
    """The document in `data`, which came from `file`, of one of `schemas`; that of a job of a batch is its answer.

    Raises DeckError (MD920, MD921).
    """
    try:
        found = json.loads(data.decode("utf-8-sig"), parse_constant=_no_number)
    except (ValueError, RecursionError) as reason:
        raise rejected("MD920", f"{file} is no JSON document: {reason}") from None
    if isinstance(found, dict) and found.get("schema") == _JOB:
        found = found.get("document")
        if not isinstance(found, dict):
            raise rejected(
                "MD920", f"{file} is a job without an answer: its deck was rejected, only checked, or interrupted"
            )
    schema = found.get("schema") if isinstance(found, dict) else None
    if not isinstance(schema, str) or not schema.startswith("mouse."):
        raise rejected("MD920", f"{file} is JSON, but no document of mouse: it has no `schema` that begins with mouse.")
    if schema not in schemas:
        raise rejected("MD921", f"{file} is {schema[:60]}; expected {', '.join(schemas)}")
    return Part(found, file)


def updates(document: Part) -> list[tuple[str, str, Part]]:
    """Updates in the document: a key for ids, the name of the model, and what was found of it."""
    if document.text("schema") == "mouse.result/1":
        return [("model", "the model", document)]
    if document.text("schema") == "mouse.arrangements/1":
        return [("all", "the model with all mechanisms", document)]
    both = (("baseline", "the model as it is"), ("extended", "the extended model"))
    return [(key, name, document.part(key)) for key, name in both if document.part(key)]


def columns(components: list[Part], modes: list[str], key: str) -> np.ndarray:
    """Values `key` (s, m) of the `components` of shapes, for the modes so labelled; NaN where one is unknown."""
    dofs = {name: i for i, name in enumerate(dict.fromkeys(c.label("dof") for c in components))}
    found = np.full((len(dofs), len(modes)), np.nan)
    column = {name: i for i, name in enumerate(modes)}
    for each in components:
        value = each.number(key)
        found[dofs[each.label("dof")], column[each.label("mode")]] = np.nan if value is None else value
    return found


def rejected(code: str, message: str) -> DeckError:
    """The error for a file that is not what was asked for."""
    return DeckError.of(code, message, help="write it with `mouse run --json` or `mouse diagnose --json`")


def _finite(value: Any) -> bool:
    return type(value) in (int, float) and abs(value) < 1e100  # NaN is not


def _no_number(name: str) -> None:
    raise ValueError(f"{name} is no number in JSON")
