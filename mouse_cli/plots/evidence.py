"""Evidence of the candidates over none, as bars."""

from textwrap import fill
from typing import Any

from mouse_cli.model.diagnosis import UNKNOWN, Diagnosis
from mouse_cli.plots import AFTER, BEFORE, Plot
from mouse_cli.report.sections._diagnosis_wording import place, probable

_MOST, _WIDTH = 10, 36  # bars; characters of a line of their names


def draw(found: Diagnosis, axes: Any) -> bool:
    """Log evidence over none; the leading group is dark, and probabilities stand at the bars where one explains the data."""
    baseline, best = found.baseline, found.best
    shown = [one for one in found.explanations if one.causes][:_MOST]
    if baseline is None or not shown:
        return False
    gains = [one.log_evidence - baseline.log_evidence for one in shown]
    colours = [AFTER if best is not None and one.group == best.group else BEFORE for one in shown]
    axes.barh([_name(one) for one in shown], gains, color=colours, height=0.7)
    for i, (one, gain) in enumerate(zip(shown, gains, strict=True)):
        words = "" if found.kind == UNKNOWN else probable(one.probability)
        axes.annotate(words, (max(gain, 0.0), i), (4, 0), textcoords="offset points", va="center", fontsize=8)
    axes.axvline(0, color="black", linewidth=0.8)
    axes.margins(x=0.2)
    axes.invert_yaxis()
    axes.tick_params(axis="y", labelsize=7)
    axes.grid(axis="y", visible=False)
    axes.set_xlabel("log evidence over none; at the bars: probability of the hypothesis")
    return True


def _name(one: Any) -> str:
    sites = ", ".join(place(c.site) for c in one.causes if c.site.kind != "structure")
    return fill(f"{one.physics}: {sites}" if sites else one.physics, _WIDTH, max_lines=2, placeholder=" ...")


PLOT = Plot("evidence", 10, "Evidence for each candidate", draw)
