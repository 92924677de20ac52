"""All keys of a YAML deck together: for the reader, the JSON Schema and the reference table."""

from collections.abc import Iterator
from importlib import import_module

from mouse_cli import _registry
from mouse_cli.formats.yaml_deck.kinds import Section

_KEYS = "mouse_cli.formats.yaml_deck.keys"


def _sections() -> dict[str, Section]:
    """The sections of every module in `keys`, by name; a name stands once."""
    found: dict[str, Section] = {}
    for part in _registry.names(_KEYS):
        sections = import_module(f"{_KEYS}.{part}").SECTIONS
        twice = found.keys() & sections.keys()
        if twice:
            raise ValueError(f"two parts of the deck define {sorted(twice)}")
        found |= sections
    return {name: found[name] for name in dict.fromkeys([*_reached("deck", found), *found])}


def _reached(name: str, sections: dict[str, Section]) -> Iterator[str]:
    """`name` and the sections below it, in the order in which a deck is written."""
    yield name
    for key in sections[name].keys.values():
        _, _, below = key.kind.partition(" ")
        if below in sections:
            yield from _reached(below, sections)
    yield from sections[name].variants


SECTIONS = _sections()


def homes(key: str, section: str = "deck", path: str = "") -> Iterator[str]:
    """Full names of the mappings of a deck that have this key, in the order in which a deck is written.

    >>> list(homes("dofs"))
    ['model', 'model.supports.*', 'test.modes']
    """
    if key in SECTIONS[section].keys and path:
        yield path
    for name, own in SECTIONS[section].keys.items():
        kind, _, below = own.kind.partition(" ")
        if below in SECTIONS:
            step = f"{path}.{name}" if path else name
            yield from homes(key, below, step + {"list": "[]", "map": ".*"}.get(kind, ""))
