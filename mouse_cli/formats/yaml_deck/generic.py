"""The `generic:` of a structure: like beams whose stiffness a method may revise as a whole."""

import numpy as np

from mouse_cli.formats.yaml_deck import values as yaml_values
from mouse_cli.formats.yaml_deck.ids import ids as read_ids
from mouse_cli.formats.yaml_deck.mesh_elements import Elements
from mouse_cli.formats.yaml_deck.sections import Section
from mouse_cli.model.mesh import GenericGroup

COUPLINGS = ("k12", "k13", "k23")
_THEORIES = ("euler-bernoulli", "generic")


def generic(structure: Section, made: Elements) -> tuple[GenericGroup, ...]:
    """Every group; each element stands in one, and is a beam of a theory that has a generic form."""
    if "generic" not in structure:
        return ()
    document, what = structure.document, structure.what("generic")
    items = yaml_values.items(document, structure.nodes["generic"], what, "a list, one item for each group") or []
    fit = {int(i): _fits(s) for s in made.sets for i in s.ids}
    found, seen = [], {}
    for i, item in enumerate(items, 1):
        section = Section(document, item, "generic_group", f"{what}[{i}]")
        group = _group(section, fit)
        if group is not None:
            _once(section, group, seen)
            found.append(group)
    return tuple(found)


def _fits(members) -> bool:
    theory = members.options.get("theory") or _THEORIES[0]
    return members.type == "beam" and theory in _THEORIES


def _group(section: Section, fit: dict[int, bool]) -> GenericGroup | None:
    document, name, couplings = section.document, section.value("name"), section.value("couplings", ())
    if "elements" not in section or name is None or couplings is None:
        return None
    node = section.nodes["elements"]
    numbers = read_ids(document, node, section.what("elements"), np.array(list(fit), int))
    for word in (word for word in couplings if word not in COUPLINGS):
        message = f"{section.what('couplings')} names '{word[:20]}'; expected some of {', '.join(COUPLINGS)}"
        document.error("MD460", section.nodes["couplings"], message, "k12 couples bending, k13 and k23 torsion")
    if numbers is None:
        return None
    for number in numbers.tolist():
        if number not in fit and not document.incomplete:
            message = f"{section.what('elements')} names element {number}, which is not among the elements"
            document.error("MD403", node, message, "give numbers of elements")
        elif not fit.get(number, True):
            message = f"{section.what('elements')} names element {number}, which is no beam of Euler and Bernoulli"
            help = "give it theory: generic (antisymmetric 1/(1 + phi) for Timoshenko's), or leave it out"
            document.error("MD462", node, message, help)
    return GenericGroup(name, numbers, tuple(couplings))


def _once(section: Section, group: GenericGroup, seen: dict[int, str]) -> None:
    for number in group.elements.tolist():
        if number in seen:
            message = f"element {number} is in the generic groups '{seen[number]}' and '{group.name}'"
            section.document.error("MD461", section.nodes["elements"], message, "give it to one of them")
        seen[number] = group.name
