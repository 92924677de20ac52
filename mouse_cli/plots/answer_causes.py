"""Of an answer in JSON: probabilities of the groups of causes."""

from typing import Any

from mouse_cli.plots import AFTER, Plot
from mouse_cli.plots._answers import MOST, short
from mouse_cli.plots._line import lying
from mouse_cli.report.reading import Part


def draw(document: Part, axes: Any) -> bool:
    """Bars; of several arrangements those of the first turn."""
    judged = document.parts("groups") or [g for turn in document.parts("turns")[:1] for g in turn.parts("groups")]
    shown = [g for g in judged if g.number("probability") is not None][:MOST]
    if not shown:
        return False
    lying(axes, [short(g.text("group")) for g in shown], [g.number("probability") or 0.0 for g in shown], AFTER)
    axes.set_xlim(0, 1)
    axes.set_xlabel("probability")
    return True


PLOT = Plot("answer-causes", 40, "Probability of each group of mechanisms", draw, (Part,))
