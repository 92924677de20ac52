"""The sensors of a YAML deck: `test.sensors`, and the list `dofs` that names them or plain degrees of freedom."""

import re

import numpy as np

from mouse_cli.formats.sensor import SensorDraft
from mouse_cli.formats.yaml_deck import values as yaml_values
from mouse_cli.formats.yaml_deck.kinds import KINDS
from mouse_cli.formats.yaml_deck.nodes import Document, Node
from mouse_cli.formats.yaml_deck.sections import Section
from mouse_cli.model.geometry import DIRECTIONS

_REVERSED = re.compile(r"(.*[^-])-([TR][XYZ])", re.ASCII)
_SIGNED = re.compile(r"([-+]?)([TR][XYZ])", re.ASCII)
_FORMS = "give node and direction, at and direction, or weights"


def sensors(test: Section) -> list[SensorDraft]:
    """Those of `test.sensors`, as far as they could be read; each name stands once."""
    found: dict[str, SensorDraft] = {}
    for each in test.listed("sensors"):
        sensor = _sensor(each)
        if sensor is not None and sensor.name in found:
            message = f"two sensors are called '{sensor.name}'"
            test.document.error("MD226", each.node, message, "give each its own name")
        elif sensor is not None:
            found[sensor.name] = sensor
    return list(found.values())


def _sensor(section: Section) -> SensorDraft | None:
    """One sensor in one of its forms; None after an error."""
    name, document = section.value("name"), section.document
    given = [key for key in ("node", "at", "weights") if key in section]
    if name is None:
        return None
    if len(given) != 1 or ("direction" in section) == ("weights" in section):
        listed = ", ".join(section.nodes)
        return section.error("MD217", f"({name}) gives {listed}; expected one of the forms of a sensor", _FORMS)
    where, words = document.span(section.node), f"sensor {name}"
    if given == ["weights"]:
        shares = section.read("weights", weights)
        return None if shares is None else SensorDraft(name, where, shares, words=words)
    direction, node, at = section.read("direction", _direction), section.value("node"), _at(section)
    if direction is None or (node is None and at is None):
        return None
    return SensorDraft(name, where, direction=direction, node=node, at=at, words=words)


def _at(section: Section) -> np.ndarray | None:
    at = section.value("at")
    if at is None or len(at) == 3:
        return at
    return section.wrong("at", "MD216", f"has {len(at)} numbers; expected 3", "give x, y and z in m")


def weights(document: Document, node: Node, what: str) -> dict[int | str, float] | None:
    """Degrees of freedom, by number or label, each with a number; None after an error."""
    if not yaml_values.is_mapping(node) or not node.value:
        return yaml_values.mistyped(document, node, what, KINDS["sensor weights"].words)
    found: dict[int | str, float] = {}
    for key, value in node.value:
        dof = place(document, key, what)
        weight = yaml_values.number(document, value, f"a weight in {what}")
        if dof is None or weight is None:
            return None
        if dof in found:
            return document.error("MD207", key, f"{what} names {dof} twice", "give each degree of freedom once")
        found[dof] = weight
    return found


def place(document: Document, node: Node, what: str) -> int | str | None:
    """A degree of freedom or a sensor by number or name; None after an error."""
    if yaml_values.as_number(node) is not None:
        return yaml_values.whole(document, node, f"a number in {what}")
    return yaml_values.text(document, node, f"a value in {what}", "the number or the label of a degree of freedom")


def _direction(document: Document, node: Node, what: str) -> np.ndarray | None:
    """A unit vector (6,) over DIRECTIONS."""
    unit = np.zeros(6)
    if yaml_values.is_list(node):
        vector = yaml_values.numbers(document, node, what, KINDS["sensor direction"].words)
        if vector is None:
            return None
        length = float(np.linalg.norm(vector))
        if len(vector) != 3 or not 0 < length < np.inf:
            return yaml_values.mistyped(document, node, what, KINDS["sensor direction"].words)
        unit[:3] = vector / length
        return unit
    found = _SIGNED.fullmatch(node.value) if yaml_values.is_scalar(node) else None
    if found is None:
        return yaml_values.mistyped(document, node, what, KINDS["sensor direction"].words)
    unit[DIRECTIONS.index(found[2])] = -1.0 if found[1] == "-" else 1.0
    return unit


def listed(document: Document, node: Node, what: str, named: list[SensorDraft]) -> list[SensorDraft] | None:
    """What `dofs` lists: a number or a label is a sensor that reads that degree of freedom, 12-TY one that reads -12TY."""
    nodes = yaml_values.items(document, node, what, KINDS["dofs"].words)
    if nodes is None:
        return None
    known = {sensor.name: sensor for sensor in named}
    found = [sensor(document, item, what, known) for item in nodes]
    return None if None in found else found


def sensor(document: Document, node: Node, what: str, known: dict[str, SensorDraft]) -> SensorDraft | None:
    """The sensor that a number, a label, 12-TY, or the name of one that is `known` means; None after an error."""
    dof = place(document, node, what)
    if dof is None or dof in known:
        return known.get(dof)
    turned = _REVERSED.fullmatch(dof) if isinstance(dof, str) else None
    weights = {turned[1] + turned[2]: -1.0} if turned else {dof: 1.0}
    return SensorDraft(str(dof), document.span(node), weights, words=str(dof), plain=True)
