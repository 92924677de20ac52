"""Parameters that are properties of elements: which elements, which property, and what value they have before the test."""

from dataclasses import dataclass, field
from difflib import get_close_matches

import numpy as np

from mouse_cli.formats.draft import MeshDraft
from mouse_cli.formats.yaml_deck import values as yaml_values
from mouse_cli.formats.yaml_deck.ids import ids as read_ids
from mouse_cli.formats.yaml_deck.kinds import KINDS
from mouse_cli.formats.yaml_deck.sections import Section
from mouse_cli.model.mesh import Binding
from mouse_cli.model.units import UNDECLARED, Units
from mouse_cli.terms.elements import registry

WHOSE = ("elements", "material", "section")


@dataclass
class Bound:
    """What one parameter is bound to: its bindings, their common value (None: they differ, it is a factor) and its unit."""

    bindings: list[Binding] = field(default_factory=list)
    value: float | None = None
    unit: str = ""

    @property
    def nominal(self) -> float:
        """Value before the test, unless the deck gives one."""
        return 1.0 if self.value is None else self.value


@dataclass
class _Part:
    """Members (indices) of set `set` that have the property `name`, and its values (e,)."""

    set: int
    members: np.ndarray
    name: str
    values: np.ndarray
    unit: str


def bound(section: Section, number: int, mesh: MeshDraft | None, units: Units = UNDECLARED) -> Bound | None:
    """The elements that parameter `number` (from 0) is a property of; None when it is none, or after an error."""
    given = [key for key in (*WHOSE, "property", "factor") if key in section]
    if not given:
        return None
    document = section.document
    whose = [key for key in WHOSE if key in given]
    if mesh is None or len(whose) != 1 or "property" not in given:
        if mesh is not None or not document.incomplete:
            _incomplete(section, whose, mesh)
        return None
    clash = [key for key in ("stiffness", "mass") if key in section]
    if clash:
        message = f"{section.called} gives {clash[0]} and {whose[0]}: it moves a matrix or a property, not both"
        return document.error("MD420", section.nodes[clash[0]], message, "make two parameters of it")
    names = _names(section)
    chosen = _chosen(section, whose[0], mesh)
    if names is None or chosen is None:
        return None
    parts = [part for name in names for part in _parts(section, name, whose[0], chosen, mesh)]
    return _bound(section, number, parts, units) if parts else None


def _incomplete(section: Section, whose: list[str], mesh: MeshDraft | None) -> None:
    if mesh is None:
        message, help = (
            f"{section.called} is a property of elements, but the model has no structure",
            "give model.structure",
        )
    elif len(whose) != 1:
        message = f"{section.called} gives {' and '.join(whose) or 'no elements'}; expected one of {', '.join(WHOSE)}"
        help = "name the elements, or their material, or their section"
    else:
        message, help = f"{section.called} names {whose[0]}, but no property", "give property, such as E"
    section.document.error("MD420", section.node, message, help)


def _names(section: Section) -> list[str] | None:
    node = section.nodes["property"]
    if yaml_values.is_list(node):
        return yaml_values.texts(section.document, node, section.what("property"), KINDS["word or words"].words)
    name = yaml_values.text(section.document, node, section.what("property"))
    return None if name is None else [name]


def _chosen(section: Section, key: str, mesh: MeshDraft) -> list[np.ndarray] | None:
    """For each set, a mask of the elements that are named; None after an error."""
    node, sets = section.nodes[key], mesh.mesh.elements
    if key != "elements":
        name = section.value(key)
        return None if name is None else [np.full(len(s), name in s.origin.values()) for s in sets]
    everything = np.concatenate([np.zeros(0, int), *(s.ids for s in sets)])
    numbers = read_ids(section.document, node, section.what(key), everything)
    if numbers is None:
        return None
    absent = np.setdiff1d(numbers, everything)
    for number in absent[:20] if not section.document.incomplete else ():
        message = f"{section.what(key)} names element {number}, which is not among the elements"
        section.document.error("MD403", node, message, "give numbers of elements")
    wanted = np.unique(numbers)
    return None if len(absent) else [np.isin(s.ids, wanted) for s in sets]


def _parts(section: Section, name: str, key: str, chosen: list[np.ndarray], mesh: MeshDraft) -> list[_Part]:
    """The named elements that have the property `name`; an error when there are none, or when some named ones lack it."""
    library, found, lacking, known = registry(), [], [], set()
    owner = section.value(key) if key != "elements" else None
    for s, (members, mask) in enumerate(zip(mesh.mesh.elements, chosen, strict=True)):
        if not mask.any():
            continue
        properties = library[members.type].properties
        known |= set(properties)
        if name not in properties:
            lacking.append(members.ids[np.flatnonzero(mask)[0]])
        elif owner is None or members.origin.get(name) == owner:
            about = properties[name]
            values = members.properties.get(name)
            if values is None:
                default = np.nan if callable(about.default) or about.default is None else about.default
                values = np.full(len(members), default)
            found.append(_Part(s, np.flatnonzero(mask), name, values[mask], about.unit))
    if (lacking and owner is None) or not found:
        _nothing(section, name, key, owner, lacking, known)
        return []
    return found


def _nothing(section: Section, name: str, key: str, owner: str | None, lacking: list, known: set[str]) -> None:
    node, near = section.nodes["property"], get_close_matches(name, known, 1)
    if owner is not None and not known and section.document.incomplete:
        return  # elements that could not be read may be of it
    if owner is not None and not known:
        message, help = f"{section.called}: no element is of {key} '{owner}'", f"name a {key} that elements have"
        section.document.error("MD402", section.nodes[key], message, help)
    elif owner is not None:
        message = f"no element takes its {name} from the {key} '{owner}'"
        help = f"write '{near[0]}'" if near and near[0] != name else f"give {name} in that {key}, or name elements"
        section.document.error("MD413", node, message, help)
    else:
        message = f"element {lacking[0]} has no property '{name}'"
        help = f"write '{near[0]}'" if near else f"the properties there are {', '.join(sorted(known))}"
        section.document.error("MD413", node, message, help)


def _bound(section: Section, number: int, parts: list[_Part], units: Units) -> Bound | None:
    """A value where all elements have the same one, else a factor."""
    values = np.concatenate([part.values for part in parts])
    document, node = section.document, section.nodes["property"]
    alike = bool((values == values[0]).all())
    factor = section.value("factor", not alike and "nominal" not in section)
    if np.isnan(values).any() and (factor or "nominal" not in section):
        message = f"{section.called} is a {parts[0].name} that the elements do not give; it follows from others"
        return document.error("MD413", node, message, "give the elements a value, or the parameter a nominal value")
    if factor and not values.any():
        message = f"{section.called} is a factor of {parts[0].name}, which is 0 in all its elements"
        return document.error("MD414", node, message, "leave factor out and give the value an sd, or give a value")
    bindings = [Binding(number, part.set, part.members, part.name, bool(factor)) for part in parts]
    return Bound(bindings, None if factor else float(values[0]), "" if factor else units.of(parts[0].unit))
