"""Physics without a name: the field along the structure with its band of two standard deviations."""

from typing import Any

import numpy as np

from mouse_cli.model.diagnosis import Diagnosis
from mouse_cli.plots import Plot
from mouse_cli.plots._field import TITLE, band
from mouse_cli.plots._line import along


def draw(found: Diagnosis, axes: Any) -> bool:
    """Over the longest direction of the structure, or over the number of the site where sites are not in one line."""
    if found.field is None:
        return False
    values = found.field.values
    row = along([each.site for each in values])
    at, name = (np.arange(1.0, len(values) + 1), "number of the site") if row is None else row
    name = name if row is None else f"{name}, {found.problem.units.of('m')}"
    value, sd = (np.array([getattr(each, key) for each in values], dtype=float) for key in ("value", "sd"))
    return band(axes, at, value, sd, name, found.field.property)


PLOT = Plot("field", 15, TITLE, draw)
