"""Of an answer in JSON: parameters, prior and posterior."""

from typing import Any

import numpy as np

from mouse_cli.plots import Plot
from mouse_cli.plots._answers import MOST, short, update, values, whiskers
from mouse_cli.report.reading import Part


def draw(document: Part, axes: Any) -> bool:
    """Shift from the prior value in prior standard deviations, with one standard deviation of each."""
    found = update(document)
    shown = [p for p in found.parts("parameters") if p.number("prior_sd")][:MOST] if found else []
    if not shown:
        return False
    at, sd = np.arange(len(shown)), values(shown, "prior_sd")
    posterior = values(shown, "posterior_sd" if "posterior_sd" in shown[0].values else "sd")
    whiskers(axes, at, np.zeros(len(shown)), np.ones(len(shown)), False)
    shift = (values(shown, "posterior") - values(shown, "prior")) / sd
    whiskers(axes, at, shift, np.nan_to_num(posterior / sd), True)
    axes.axvline(0, color="black", linewidth=0.8)
    axes.set_yticks(at, [short(p.label("name")) for p in shown], fontsize=8 if len(shown) <= 12 else 6)
    axes.set_ylim(len(shown) - 0.4, -0.6)
    axes.grid(axis="y", visible=False)
    axes.set_xlabel("shift, prior standard deviations")
    axes.legend(loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=2)
    return True


PLOT = Plot("answer-parameters", 20, "Parameters, prior and posterior", draw, (Part,))
