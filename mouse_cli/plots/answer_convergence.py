"""Of an answer in JSON: chi-square after each cycle."""

from typing import Any

import numpy as np

from mouse_cli.plots import AFTER, Plot
from mouse_cli.plots._answers import values
from mouse_cli.report.reading import Part


def draw(document: Part, axes: Any) -> bool:
    """On a logarithmic axis; cycle 0 is the prior model."""
    chi2 = values(document.parts("cycles"), "chi2")
    if len(chi2) < 2 or not np.isfinite(chi2).any() or np.nanmin(chi2) <= 0:
        return False
    axes.semilogy(range(len(chi2)), chi2, marker="o", markersize=3.5, color=AFTER)
    axes.xaxis.get_major_locator().set_params(integer=True)
    axes.set_xlabel("cycle")
    axes.set_ylabel("chi-square")
    return True


PLOT = Plot("answer-convergence", 70, "Chi-square after each cycle", draw, (Part,))
