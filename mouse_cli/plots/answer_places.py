"""Of an answer in JSON: probability of each place where one force could make all measured shapes."""

from typing import Any

from mouse_cli.plots import AFTER, Plot
from mouse_cli.plots._answers import words
from mouse_cli.plots._line import lying
from mouse_cli.report.reading import Part

_MOST = 15  # bars


def draw(document: Part, axes: Any) -> bool:
    """Bars, the most probable on top."""
    shown = document.part("location").parts("places")[:_MOST]
    if not shown:
        return False
    names = [f"{words(p.part('site'))} {p.text('channel')}" for p in shown]
    lying(axes, names, [p.number("probability") or 0.0 for p in shown], AFTER)
    axes.set_xlabel("probability")
    return True


PLOT = Plot("answer-places", 50, "Where one force could make all measured shapes", draw, (Part,))
