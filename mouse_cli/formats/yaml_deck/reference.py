"""The definitions of the YAML deck for others: a JSON Schema for editors, a table for readers."""

import re
from collections.abc import Iterator
from typing import Any

from mouse_cli.formats.yaml_deck.kinds import KINDS, VERSION, Key, Section
from mouse_cli.formats.yaml_deck.schema import SECTIONS


def schema() -> dict[str, Any]:
    """The JSON Schema of decks and manifests, shipped beside this file as deck.schema.json and printed by `mouse explain schema`.

    A file with the key `batch` is a manifest, any other a deck: one schema serves an editor for all files of mouse.
    """
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "$id": f"urn:mouse:deck:{VERSION}",
        "title": f"mouse deck, version {VERSION}",
        "description": "A deck of mouse, or with the key `batch` a manifest of many.",
        "if": {"required": ["batch"]},
        "then": {"$ref": "#/$defs/manifest"},
        "else": {"$ref": "#/$defs/deck"},
        "$defs": {name: _section(section) for name, section in SECTIONS.items()},
    }


def reference() -> str:
    """Every key in Markdown: one table for each section."""
    parts = [_table(name, section) for name, section in SECTIONS.items()]
    return "\n".join(["# The keys of a YAML deck", "", _NUMBERS, "", *parts])


def entries() -> Iterator[tuple[str, str]]:
    """What each key and section of a deck means, by its name: `shapes`, `modes`, and by `modes.shapes` in that section alone."""
    for name, section in SECTIONS.items():
        yield name, _plain(f"section {_table(name, section).removeprefix('## ').rstrip()}")
        for key, definition in section.keys.items():
            text = _plain(_entry(name, key, definition))
            yield key, text
            yield f"{name}.{key}", text


def _plain(text: str) -> str:
    """Without Markdown's links, for a terminal."""
    return re.sub(r"\[(\w+)\]\(#\w+\)", r"\1", text)


def _entry(section: str, name: str, key: Key) -> str:
    unit = f"unit: {key.unit}" if key.unit else ""
    default = "required" if key.required else f"default: {key.default}" if key.default else ""
    facts = "\n".join(filter(None, [f"value: {_words(key)}", unit, default]))
    return f"deck key {name}, in section {section}\n\n{key.meaning}\n{facts}"


_NUMBERS = (
    "Numbers are written as `1`, `2.5`, `1e5` or `2.5e+05`; `.inf` and `.nan` are read too. "
    "From 1e150 on a number counts as infinite, for no products can be made of it. A leading "
    "zero means nothing: `010` is ten. An empty value, `~` and `null` mean that the key is not given."
)


def _section(section: Section) -> dict[str, Any]:
    if section.variants:
        return {"description": section.meaning, "anyOf": [{"$ref": f"#/$defs/{name}"} for name in section.variants]}
    if not section.forms:
        found = _object(section.meaning, section.keys, [key for key in section.keys if section.keys[key].required])
        return {**found, "anyOf": [_given(keys) for keys in section.needs]} if section.needs else found
    forms = [_object("", {key: section.keys[key] for key in form}, list(form)) for form in section.forms]
    return {"description": section.meaning, "oneOf": forms}


def _given(keys: tuple[str, ...]) -> dict[str, Any]:
    """All of `keys` are there, with a value."""
    return {"required": list(keys), "properties": {key: {"not": {"type": "null"}} for key in keys}}


def _object(meaning: str, keys: dict[str, Key], required: list[str]) -> dict[str, Any]:
    described = {"description": meaning} if meaning else {}
    properties = {name: _value(key, name in required) for name, key in keys.items()}
    return {
        **described,
        "type": "object",
        "additionalProperties": False,
        "required": required,
        "properties": properties,
    }


def _value(key: Key, required: bool) -> dict[str, Any]:
    unit = f" [{key.unit}]" if key.unit else ""
    default = f"; default: {key.default}" if key.default else ""
    limits = {"minimum": key.low, "maximum": key.high}
    bounds = {name: limit for name, limit in limits.items() if limit is not None}
    checked = {**_kind(key), **bounds}
    return {"description": f"{key.meaning}{unit}{default}"} | (
        checked if required else {"anyOf": [checked, {"type": "null"}]}
    )


def _kind(key: Key) -> dict[str, Any]:
    kind, _, name = key.kind.partition(" ")
    if kind == "section":
        return {"$ref": f"#/$defs/{name}"}
    if kind == "list":
        return {"type": "array", "items": {"$ref": f"#/$defs/{name}"}}
    if kind == "map":
        return {"type": "object", "additionalProperties": {"$ref": f"#/$defs/{name}"}}
    return {"enum": list(key.choices)} if key.choices else KINDS[key.kind].schema


def _table(name: str, section: Section) -> str:
    if section.variants:
        links = ", ".join(f"[{variant}](#{variant})" for variant in section.variants)
        return "\n".join([f"## {name}", "", f"{section.meaning} {links}.", ""])
    rows = [_row(key, definition) for key, definition in section.keys.items()]
    head = ["| key | value | default | unit | meaning |", "|---|---|---|---|---|"]
    forms = " or ".join("`" + "` with `".join(form) + "`" for form in section.forms)
    rule = [f"Exactly one of: {forms}.", ""] if forms else []
    if section.needs:
        needs = " or ".join("`" + "` with `".join(keys) + "`" for keys in section.needs)
        rule = [f"At least one of: {needs}.", ""]
    return "\n".join([f"## {name}", "", section.meaning, "", *rule, *head, *rows, ""])


def _row(name: str, key: Key) -> str:
    default = "required" if key.required else key.default
    return f"| `{name}` | {_words(key)} | {default} | {key.unit} | {key.meaning} |"


_LINKED = {"section": "{}", "list": "a list of {}", "map": "{{name: {}, ...}}"}


def _words(key: Key) -> str:
    kind, _, name = key.kind.partition(" ")
    if kind in _LINKED:
        return _LINKED[kind].format(f"[{name}](#{name})")
    if key.choices:
        return ", ".join(f"`{choice}`" for choice in key.choices)
    return KINDS[key.kind].words
