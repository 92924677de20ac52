"""Evidence of the candidates over none, as bars."""

from typing import Any

from mouse_cli.model.diagnosis import Diagnosis
from mouse_cli.plots import AFTER, BEFORE, Plot
from mouse_cli.report.sections._diagnosis_wording import with_p

_MOST = 10


def draw(found: Diagnosis, axes: Any) -> bool:
    """ln evidence over none; the leading group is dark, and probabilities stand at the bars."""
    baseline, best = found.baseline, found.best
    shown = [one for one in found.explanations if one.causes][:_MOST]
    if baseline is None or not shown:
        return False
    gains = [one.log_evidence - baseline.log_evidence for one in shown]
    colours = [AFTER if best is not None and one.group == best.group else BEFORE for one in shown]
    axes.barh([_name(one) for one in shown], gains, color=colours, height=0.7)
    for i, (one, gain) in enumerate(zip(shown, gains, strict=True)):
        axes.annotate(
            with_p(one.probability), (max(gain, 0.0), i), (4, 0), textcoords="offset points", va="center", fontsize=8
        )
    axes.axvline(0, color="black", linewidth=0.8)
    axes.margins(x=0.2)
    axes.invert_yaxis()
    axes.tick_params(axis="y", labelsize=7)
    axes.grid(axis="y", visible=False)
    axes.set_xlabel("ln evidence over no cause, nats")
    return True


def _name(one: Any) -> str:
    sites = ", ".join(c.site.text or " ".join(map(str, c.site.ids)) for c in one.causes if c.site.kind != "structure")
    return f"{one.physics}: {sites}" if sites and len(sites) < 52 else one.physics


PLOT = Plot("evidence", 10, "Evidence for each candidate", draw)
