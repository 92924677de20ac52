"""Files whose channels name their sensors, as universal files do: each is `12TY`, or `12-TY` where it points backwards."""

import re

import numpy as np

from mouse_cli.formats.record_drafts import Pick
from mouse_cli.formats.recording_files import Contents
from mouse_cli.formats.sensor import SensorDraft
from mouse_cli.model.channel_units import unit as spelled_unit
from mouse_cli.model.geometry import DIRECTIONS
from mouse_cli.model.recording import FORCES, INPUT, OUTPUT

_OWN = re.compile(r"([0-9]+)(-?)([TR][XYZ])", re.ASCII)
_GROUND = re.compile(r"ground(-?)(T[XYZ])?", re.ASCII)


def own_sensor(name: str, where=None, words: str = "") -> SensorDraft | None:
    """The sensor that such a name means, or the motion of the ground; None for other names."""
    if (moving := ground(name)) is not None:
        return SensorDraft(name, where, words=words or f"sensor {name} of the file", ground=moving)
    found = _OWN.fullmatch(name)
    if found is None:
        return None
    weights = {found[1] + found[3]: -1.0 if found[2] else 1.0}
    return SensorDraft(name, where, weights, words=words or f"sensor {name} of the file")


def ground(name: str) -> np.ndarray | None:
    """Unit vector (6,) of `groundTX`, `ground-TX`; zeros for `ground` alone; None for other names."""
    found = _GROUND.fullmatch(name)
    if found is None:
        return None
    unit = np.zeros(6)
    if found[2]:
        unit[DIRECTIONS.index(found[2])] = -1.0 if found[1] else 1.0
    return None if found[1] and not found[2] else unit


def own_picks(contents: Contents) -> list[Pick]:
    """The channels that name their sensors: inputs where the unit is one of force."""
    found = []
    for i, column in enumerate(contents.columns, 1):
        sensor, spelled = own_sensor(column.name), spelled_unit(column.unit)
        if sensor is not None:
            forced = spelled is not None and spelled.quantity in FORCES
            role = INPUT if forced or sensor.ground is not None else OUTPUT
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
