"""The `materials:` and `sections:` of a structure: numbers by name."""

from mouse_cli.formats.yaml_deck.cross_sections import DIMENSIONS, SHAPES, impossible
from mouse_cli.formats.yaml_deck.sections import Section

Named = dict[str, dict[str, float | None]]  # None: given, and no number


def materials(structure: Section) -> Named:
    """Properties of each material, as given."""
    return {name: _numbers(section) for name, section in structure.named("materials").items()}


def cross_sections(structure: Section) -> Named:
    """Properties of each cross section: those of its shape, replaced by what is given."""
    found = structure.named("sections")
    return {name: _shape(section) | _numbers(section) for name, section in found.items()}


def _numbers(section: Section) -> dict[str, float | None]:
    return {key: section.value(key) for key in section.nodes if key not in SHAPES}


def _shape(section: Section) -> dict[str, float]:
    given = [key for key in SHAPES if key in section]
    if not given:
        return {}
    if len(given) > 1:
        message = f"{section.called} gives {' and '.join(given)}; a section has one shape"
        section.document.error("MD217", section.node, message, "delete one of the two")
        return {}
    shape, node = given[0], section.nodes[given[0]]
    value = section.value(shape)
    if value is None:
        return {}
    dimensions = [value] if DIMENSIONS[shape] == 1 else value.tolist()
    if len(dimensions) != DIMENSIONS[shape]:
        message = f"{section.what(shape)} has {len(dimensions)} numbers; expected {DIMENSIONS[shape]}"
        section.document.error("MD216", node, message, f"give {section.definition.keys[shape].meaning}")
        return {}
    if impossible(shape, dimensions):
        message = f"{section.what(shape)} is {section.document.written(node)}: there is no such shape"
        section.document.error("MD408", node, message, "give positive dimensions, and walls that fit within them")
        return {}
    return SHAPES[shape](*dimensions)
