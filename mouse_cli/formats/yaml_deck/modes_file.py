"""`test.modes: file:` of a YAML deck: frequencies and shapes of a universal file."""

from dataclasses import replace

import numpy as np

from mouse_cli._span import Span
from mouse_cli.formats.mode_files import ModeTable, read_modes
from mouse_cli.formats.own_names import own_sensor
from mouse_cli.formats.sensor import SensorDraft
from mouse_cli.formats.yaml_deck.files import read_below
from mouse_cli.formats.yaml_deck.sections import Section
from mouse_cli.model.channel_units import unit
from mouse_cli.model.units import Units

_SHOWN = 12  # names of sensors in a message


def of_file(modes: Section, units: Units) -> ModeTable | None:
    """The modes of the file that `modes` names, in the units of the deck, shapes of unit modal mass; None after an error."""
    document, node = modes.document, modes.nodes["file"]
    for key in ("frequency", "shapes"):
        if key in modes:
            modes.wrong(key, "MD217", f"stands beside {modes.what('file')}, which gives it", f"delete {key}, or file")
    held = read_below(document, node, modes.called, read_modes)
    if held is not None and modes.value("mount", "numbers") == "numbers":
        held = replace(held, surveyed={})
    elif held is not None and not held.surveyed and not held.places:
        message = f"{modes.what('mount')} is coordinates, and the file has none"
        document.error("MD600", modes.nodes["mount"], message, "export data set 15 or 2411 with the modes")
    if held is not None and held.metre is not None and units.declared:
        size = held.metre / units.metre
        at = {name: (tuple(size * x for x in place), vector) for name, (place, vector) in held.surveyed.items()}
        held = replace(held, surveyed=at)
    if held is None or held.mass_kg is None:
        return held
    own = unit(units.force).factor / units.metre if units.declared else 1.0
    return replace(held, shapes=held.shapes * np.sqrt(own / held.mass_kg))


def own_sensors(modes: Section, held: ModeTable) -> list[SensorDraft]:
    """All sensors of the file, by its names."""
    where = modes.document.span(modes.nodes["file"])
    words = lambda name: f"sensor {name} of {modes.what('file')}"
    return [
        _placed(held, name, where, words(name))
        or own_sensor(name, where, words(name))
        or SensorDraft(name, where, words=words(name))
        for name in held.names
    ]


def mounted(modes: Section, held: ModeTable, dofs: list[SensorDraft]) -> list[SensorDraft]:
    """`dofs` with those that the file places by coordinates at these."""
    found = []
    for sensor in dofs:
        name = sensor.name if sensor.name in held.names else sensor.name.replace("-", "")
        placed = _placed(held, name, sensor.where, sensor.words)
        turned = placed is not None and name != sensor.name
        found.append(replace(placed, name=sensor.name, direction=-placed.direction) if turned else placed or sensor)
    return found


def _placed(held: ModeTable, name: str, where: Span, words: str) -> SensorDraft | None:
    """The sensor of a row that gives coordinates, or a node and the components of a direction."""
    if name in held.surveyed:
        place, vector = held.surveyed[name]
        return SensorDraft(name, where, direction=np.array(vector), at=np.array(place), words=words)
    if name not in held.places:
        return None
    place, direction = held.places[name], np.array(held.directions[name])
    if isinstance(place, int):
        return SensorDraft(name, where, direction=direction, node=place, words=words)
    return SensorDraft(name, where, direction=direction, at=np.array(place), words=words)


def chosen(modes: Section, held: ModeTable, dofs: list[SensorDraft]) -> tuple[np.ndarray, np.ndarray | None] | None:
    """The rows of shapes at `dofs`, each by its name in the file, reversed where that is, and their sd; None after an error."""
    rows, places = [], []
    for sensor in dofs:
        backwards = sensor.name.replace("-", "")
        name, sign = (sensor.name, 1.0) if sensor.name in held.names else (backwards, -1.0)
        if name not in held.names:
            message = f"the file has no shape at '{sensor.name}'"
            note = f"it has {', '.join(held.names[:_SHOWN])}{', ...' if len(held.names) > _SHOWN else ''}"
            node = modes.nodes.get("dofs", modes.nodes["file"])
            return modes.document.error("MD600", node, message, "name sensors as the file does", note)
        places.append(held.names.index(name))
        rows.append(sign * held.shapes[places[-1]])
    shape_sd = None if held.shape_sd is None else held.shape_sd[places]
    return np.array(rows).reshape(len(dofs), len(held.frequency_hz)), shape_sd
