"""Of an answer in JSON: physics without a name along the structure, with its band of two standard deviations."""

from typing import Any

import numpy as np

from mouse_cli.model.diagnosis import Site
from mouse_cli.plots import Plot
from mouse_cli.plots._answers import values
from mouse_cli.plots._field import TITLE, band
from mouse_cli.plots._line import along
from mouse_cli.report.reading import Part


def draw(document: Part, axes: Any) -> bool:
    """Over the longest direction of the structure, or over the number of the site where sites are not in one line."""
    found = document.part("verdict").part("field")
    every = found.parts("sites")
    points = [[x for x in each.numbers("position") if x is not None] for each in every]
    row = along([Site("", (), tuple(p) if len(p) == 3 else None) for p in points])
    at, name = (np.arange(1.0, len(every) + 1), "number of the site") if row is None else row
    return band(axes, at, values(every, "value"), values(every, "sd"), name, found.text("property"))


PLOT = Plot("answer-field", 45, TITLE, draw, (Part,))
