"""Files whose channels name their sensors, as universal files do: each is `12TY`, or `12-TY` where it points backwards."""

import re

from mouse_cli.formats.record_drafts import Pick
from mouse_cli.formats.recording_files import Contents
from mouse_cli.formats.sensor import SensorDraft
from mouse_cli.model.channel_units import unit
from mouse_cli.model.geometry import DIRECTIONS
from mouse_cli.model.recording import INPUT, OUTPUT

_OWN = re.compile(r"([0-9]+)(-?)([TR][XYZ])", re.ASCII)
_FORCES = ("force", "moment")


def own_sensor(name: str, where=None, words: str = "") -> SensorDraft | None:
    """The sensor that such a name means; None for other names."""
    found = _OWN.fullmatch(name)
    if found is None:
        return None
    weights = {found[1] + found[3]: -1.0 if found[2] else 1.0}
    return SensorDraft(name, where, weights, words=words or f"sensor {name} of the file")


def own_picks(contents: Contents) -> list[Pick]:
    """The channels that name their sensors: inputs where the unit is one of force."""
    found = []
    for i, column in enumerate(contents.columns, 1):
        sensor, spelled = own_sensor(column.name), unit(column.unit)
        if sensor is not None:
            role = INPUT if spelled is not None and spelled.quantity in _FORCES else OUTPUT
            found.append(Pick(sensor, role, str(i)))
    return found


def direction_code(name: str) -> tuple[int, int] | None:
    """Node and direction, 1 to 6, negative where it points backwards, as universal files number them; 0 for a bare number.

    >>> direction_code("12-RZ"), direction_code("7")
    ((12, -6), (7, 0))
    """
    if name.isascii() and name.isdecimal():
        return int(name), 0
    found = _OWN.fullmatch(name)
    if found is None:
        return None
    code = DIRECTIONS.index(found[3]) + 1
    return int(found[1]), -code if found[2] else code
