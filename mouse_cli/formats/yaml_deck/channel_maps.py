"""Sensors and the channels they are, as `inputs` and `outputs` of a YAML deck give them."""

from dataclasses import replace

from mouse_cli.formats.own_names import ground
from mouse_cli.formats.record_drafts import Pick
from mouse_cli.formats.sensor import SensorDraft
from mouse_cli.formats.yaml_deck import sensors as yaml_sensors
from mouse_cli.formats.yaml_deck import values as yaml_values
from mouse_cli.formats.yaml_deck.frf_parts import gain_sd, share
from mouse_cli.formats.yaml_deck.kinds import KINDS
from mouse_cli.formats.yaml_deck.nodes import Node
from mouse_cli.formats.yaml_deck.sections import Section
from mouse_cli.model.recording import ABSOLUTE, OUTPUT

Known = dict[str, SensorDraft]


def pairs(section: Section, key: str, known: Known, below: str) -> list[tuple[SensorDraft, Node | Section]]:
    """Each sensor of a key with what stands for it: the node of a name, or a section `below`; what is wrong is left out."""
    node, what, document = section.nodes.get(key), section.what(key), section.document
    if node is None:
        return []
    words = KINDS[section.definition.keys[key].kind].words
    if yaml_values.is_list(node):
        sections = [Section(document, item, below, f"{what}[{i}]") for i, item in enumerate(node.value, 1)]
        found = [(_sensor(each, known), each) for each in sections]
    elif yaml_values.is_mapping(node) and node.value:
        found = [
            (placed(section, name, what, known), _below(section, what, name, item, below)) for name, item in node.value
        ]
    else:
        yaml_values.mistyped(document, node, what, words)
        return []
    return [(sensor, item) for sensor, item in found if sensor is not None and item is not None]


def placed(section: Section, node: Node, what: str, known: Known) -> SensorDraft | None:
    """The sensor that `node` names; findings on it say so in words of their own, since it is not in a list of `dofs`."""
    if yaml_values.is_scalar(node) and node.value not in known and (moving := ground(node.value)) is not None:
        words = f"sensor {node.value} of {what}"
        return SensorDraft(node.value, section.document.span(node), words=words, ground=moving)
    found = yaml_sensors.sensor(section.document, node, what, known)
    plain = found is not None and found.plain
    return replace(found, words=f"sensor {found.name} of {what}", plain=False) if plain else found


def _sensor(section: Section, known: Known) -> SensorDraft | None:
    node = section.nodes.get("sensor")
    if node is None:
        return section.error("MD211", "names no sensor", "give sensor: a degree of freedom or a name of sensors")
    return placed(section, node, section.what("sensor"), known)


def _below(section: Section, what: str, name: Node, node: Node, below: str) -> Node | Section | None:
    """A plain name as it is; a mapping as a section, in which the sensor may not stand again."""
    document = section.document
    if not yaml_values.is_mapping(node):
        text = yaml_values.text(document, node, f"{what}.{name.value}", "a name, a number, or a mapping")
        return None if text is None else node
    found = Section(document, node, below, f"{what}.{name.value}")
    if "sensor" in found:
        message = f"{found.called} names its sensor twice"
        return document.error("MD207", found.nodes["sensor"], message, "delete sensor")
    return found


def picks(section: Section, key: str, role: str, known: Known, usual: tuple[float, float]) -> list[Pick]:
    """The channels of a recording that `inputs` or `outputs` chooses; usual: sd of gain and delay where a channel states none."""
    found, frame = [], section.value("frame", ABSOLUTE)
    for sensor, item in pairs(section, key, known, "channel"):
        own, errors = (frame, usual) if role == OUTPUT else (ABSOLUTE, (usual[0], 0.0))
        noise = None
        if isinstance(item, Section):
            where = section.document.span(item.nodes.get("channel", item.node))
            texts = [item.value(name, "") for name in ("channel", "quantity", "unit", "sensitivity")]
            sensor, own, errors = _moving(item, sensor), item.value("frame", own), uncertain(item, errors)
            noise = share(item, "noise_sd", "write the share of the rms of the channel that is noise, such as 1 %")
        else:
            where, texts = section.document.span(item), [item.value, "", "", ""]
        found.append(Pick(sensor, role, *texts, where, own, *errors, noise or 0.0))
    return found


def uncertain(section: Section, usual: tuple[float, float] = (0.0, 0.0)) -> tuple[float, float]:
    """Standard deviations of gain and delay, s, that a section states; the usual ones where it states none."""
    own = section.value("delay_sd", usual[1])
    if "delay_sd" in section and not 0 <= own < float("inf"):
        section.wrong("delay_sd", "MD215", f"is {own:g}; it must be 0 or more", "give it in s")
    return gain_sd(section) or usual[0], own


def _moving(item: Section, sensor: SensorDraft) -> SensorDraft:
    """The motion of the ground with what `moves` says that it carries along; any other sensor as it is."""
    if "moves" not in item:
        return sensor
    node = item.nodes["moves"]
    if sensor.ground is None:
        message = (
            f"{item.what('moves')} states what the ground carries along, but {sensor.words} is no motion of the ground"
        )
        item.document.error("MD644", node, message, "delete moves, or call the sensor ground")
        return sensor
    return replace(sensor, weights=item.read("moves", yaml_sensors.weights) or {})
