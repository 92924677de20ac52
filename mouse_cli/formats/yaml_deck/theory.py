"""The `theory:` of a YAML deck, and its way back."""

from dataclasses import fields

from mouse_cli.formats.yaml_deck import values as yaml_values
from mouse_cli.formats.yaml_deck.sections import Section
from mouse_cli.formats.yaml_deck.text import real
from mouse_cli.model.theory import Theory


def theory(deck: Section) -> Theory:
    """What the deck gives; defaults where it gives none, or after an error."""
    section = deck.section("theory")
    given = {} if section is None else {key: _share(section, key) for key in section.nodes}
    return Theory(**{key: value for key, value in given.items() if value is not None})


def _share(section: Section, key: str) -> float | None:
    """A number or a percentage, above 0 and at most 1."""
    value = section.read(key, yaml_values.share)
    if value is None or 0 < value <= 1:
        return value
    help = "write a share such as 0.1 % or 0.001; for a model that is exact a very small one"
    return section.wrong(key, "MD215", f"is {value:g}; it must be above 0 and at most 1", help)


def theory_lines(found: Theory) -> list[str]:
    """The section as a deck has it, defaults written out."""
    given = ", ".join(f"{each.name}: {real(getattr(found, each.name))}" for each in fields(found))
    return ["", f"theory: {{{given}}}"]
