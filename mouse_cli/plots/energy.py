"""Where the stiffness of the model and the measured shapes part: the energy error of each element."""

from typing import Any

import numpy as np

from mouse_cli.model.diagnosis import Diagnosis
from mouse_cli.plots import BEFORE, Plot
from mouse_cli.plots._line import along, lying
from mouse_cli.report.sections._diagnosis_wording import place

_MOST = 15  # bars, where places are not in one line


def draw(found: Diagnosis, axes: Any) -> bool:
    """Share of each element along the longest direction of the structure; bars of the largest where it is no line."""
    energy = found.energy
    if energy is None:
        return False
    value, share, row = "share of the energy, per cent", 100 * energy.share, along(energy.sites)
    if row is None:
        shown = energy.order[:_MOST]
        lying(axes, [place(energy.sites[i]) for i in shown], share[shown].tolist(), BEFORE)
        axes.set_xlabel(value)
        return True
    at, name = row
    order = np.argsort(at, kind="stable")
    axes.vlines(at[order], 0, share[order], color=BEFORE, linewidth=1.0)
    axes.plot(at[order], share[order], "o", markersize=3, color="black")
    axes.set_xlabel(f"{name}, {found.problem.units.of('m')}")
    axes.set_ylabel(value)
    return True


PLOT = Plot("energy", 25, "Energy by which stresses and strains disagree", draw)
