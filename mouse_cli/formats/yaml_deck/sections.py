"""Mappings of a deck, checked against their definition: unknown, doubled, missing and excluded keys."""

from collections.abc import Callable
from difflib import get_close_matches
from typing import Any

from mouse_cli.formats.yaml_deck import schema as yaml_schema
from mouse_cli.formats.yaml_deck import values as yaml_values
from mouse_cli.formats.yaml_deck.kinds import KINDS, Key
from mouse_cli.formats.yaml_deck.nodes import Document, Node, is_null

_SIMPLE = {
    "text": yaml_values.text,
    "flag": yaml_values.flag,
    "whole": yaml_values.whole,
    "number": yaml_values.number,
    "texts": yaml_values.texts,
    "numbers": yaml_values.numbers,
    "wholes": yaml_values.wholes,
}


class Section:
    """The keys that were given, as nodes; an empty value counts as not given."""

    def __init__(self, document: Document, node: Node, name: str, called: str = ""):
        self.document, self.node, self.called = document, node, called
        self.definition = yaml_schema.SECTIONS[name]
        self.nodes: dict[str, Node] = {}
        self._misspelt: set[str] = set()  # keys that unknown ones are close to: these are not missing besides
        if not yaml_values.is_mapping(node) or ":" in node.tag:
            yaml_values.mistyped(document, node, called or "the deck", f"a mapping of {_listed(self.definition.keys)}")
            return
        self._take()
        self._require()

    def __contains__(self, key: str) -> bool:
        return key in self.nodes

    def what(self, key: str) -> str:
        """Full name of a key, for messages."""
        return f"{self.called}.{key}" if self.called else key

    def error(self, code: str, message: str, help: str = "") -> None:
        """Note an error of the section as a whole; `message` goes on from its name."""
        self.document.error(code, self.node, f"{self.called} {message}", help)

    def wrong(self, key: str, code: str, message: str, help: str = "") -> None:
        """Note an error of the value of a key; `message` goes on from its full name."""
        self.document.error(code, self.nodes[key], f"{self.what(key)} {message}", help)

    def value(self, key: str, default: object = None) -> object:
        """The value of a key of a simple kind; `default` when it is not given or was refused."""
        node = self.nodes.get(key)
        if node is None:
            return default
        value = self._read(node, key, self.definition.keys[key])
        return default if value is None else value

    def section(self, key: str) -> "Section | None":
        """The section below a key; None when it is not given."""
        node = self.nodes.get(key)
        kind = self.definition.keys[key].kind.removeprefix("section ")
        return None if node is None else Section(self.document, node, kind, self.what(key))

    def listed(self, key: str) -> "list[Section]":
        """The sections of a list; empty when it is not given."""
        node, what, kind = self.nodes.get(key), self.what(key), self.definition.keys[key].kind.removeprefix("list ")
        items = None if node is None else yaml_values.items(self.document, node, what, "a list of mappings")
        return [Section(self.document, item, kind, f"{what}[{i}]") for i, item in enumerate(items or [], 1)]

    def read(self, key: str, reader: Callable, *more: object) -> Any:
        """What `reader(document, node, name, *more)` makes of the value of a key; None when it is not given."""
        node = self.nodes.get(key)
        return None if node is None else reader(self.document, node, self.what(key), *more)

    def named(self, key: str) -> "dict[str, Section]":
        """The sections below a key that maps names to sections; empty when it is not given."""
        node = self.nodes.get(key)
        what, kind = self.what(key), self.definition.keys[key].kind.removeprefix("map ")
        if node is None:
            return {}
        if not yaml_values.is_mapping(node):
            yaml_values.mistyped(self.document, node, what, "a mapping of names")
            return {}
        found: dict[str, Section] = {}
        for name, value in node.value:
            if yaml_values.text(self.document, name, f"a name in {what}") is None:
                continue
            if name.value in found:
                self.document.error("MD207", name, f"{what} names '{name.value}' twice", "delete one of the two")
            else:
                found[name.value] = Section(self.document, value, kind, f"{what}.{name.value}")
        return found

    def form(self) -> str | None:
        """The last key of the one form that was given; None after an error."""
        forms = self.definition.forms
        given = [form for form in forms if any(key in self for key in form)]
        used = {key for form in given for key in form}
        exact = [form for form in given if set(form) == set(self.nodes)]
        if exact:
            return exact[0][-1]
        if len(given) == 1:
            absent = [key for key in given[0] if key not in self]
            for key in absent:
                self._missing(key)
            return None if absent else given[0][-1]
        choices = "; ".join(" with ".join(form) for form in forms)
        message = f"{self.called} gives {_listed(used) if used else 'none of its forms'}; expected exactly one form"
        if self.nodes or yaml_values.is_mapping(self.node):
            self.document.error("MD217", self.node, message, f"give one of: {choices}")
        return None

    def _take(self) -> None:
        seen: set[str] = set()
        for key, value in self.node.value:
            if self.document.full:
                return
            name = key.value if yaml_values.is_scalar(key) else yaml_values.shown(key)
            if name in seen:
                message = f"key '{name}' is given twice"
                self.document.error("MD207", key, message, "delete one of the two", gap=False)
            elif not yaml_values.is_scalar(key) or name not in self.definition.keys:
                self._unknown(key, name)
            elif not is_null(value):
                self.nodes[name] = value
            seen.add(name)

    def _unknown(self, key: Node, name: str) -> None:
        known, place = self.definition.keys, self.called or "a deck"
        near = get_close_matches(name, known, 1)
        self._misspelt.update(near)
        help = f"write '{near[0]}'" if near else f"{_elsewhere(name, place)}the keys of {place} are {_listed(known)}"
        self.document.error("MD210", key, f"'{name[:40]}' is not a key of {place}", help)

    def _require(self) -> None:
        for key, definition in self.definition.keys.items():
            if definition.required and key not in self:
                self._missing(key)
        needs = self.definition.needs
        if needs and not any(all(key in self for key in keys) for keys in needs):
            begun = next((keys for keys in needs if any(key in self for key in keys)), needs[0])
            for key in begun:
                if key not in self:
                    self._missing(key)

    def _missing(self, key: str) -> None:
        if key in self._misspelt:
            return
        place = next((k for k, _ in self.node.value if k.value == key), self.node)
        definition = self.definition.keys[key]
        self.document.error("MD211", place, f"{self.what(key)} is missing", f"give {key}: {definition.meaning}")

    def _read(self, node: Node, key: str, definition: Key) -> object:
        what, words = self.what(key), KINDS[definition.kind].words
        if definition.kind == "choice":
            return self._choice(node, what, definition)
        if definition.kind == "maybes":
            return yaml_values.numbers(self.document, node, what, words, missing=True)
        value = _SIMPLE[definition.kind](self.document, node, what, words)
        return self._limited(node, what, value, definition) if definition.kind in ("whole", "number") else value

    def _choice(self, node: Node, what: str, definition: Key) -> object:
        word = yaml_values.text(self.document, node, what, f"one of {_listed(definition.choices)}")
        chosen = {str(choice): choice for choice in definition.choices}
        if word is None or word in chosen:
            return chosen.get(word)
        near = get_close_matches(word, chosen, 1)
        help = f"write {near[0]}" if near else f"give one of {_listed(definition.choices)}"
        message = f"{what} is '{word[:40]}'; expected one of {_listed(definition.choices)}"
        return self.document.error("MD214", node, message, help)

    def _limited(self, node: Node, what: str, value: float | None, definition: Key) -> float | None:
        low, high = definition.low, definition.high
        if value is None or ((low is None or value >= low) and (high is None or value <= high)):
            return value
        limits = f"at least {low}" if high is None else f"{low}" if low == high else f"from {low} to {high}"
        return self.document.error("MD215", node, f"{what} is {value}; it must be {limits}", f"give a number {limits}")


def _elsewhere(key: str, place: str) -> str:
    """Where a key belongs that `place` has not, as the beginning of a sentence: below `place` if it can be."""
    home = max(yaml_schema.homes(key), key=lambda home: home.startswith(place), default="")
    return f"'{key}' is a key of {home}; " if home else ""


def _listed(words: object) -> str:
    return ", ".join(str(word) for word in words)
