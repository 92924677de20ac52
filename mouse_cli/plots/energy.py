"""Where the stiffness of the model and the measured shapes part: the energy error of each element."""

from typing import Any

import numpy as np

from mouse_cli.model.diagnosis import Diagnosis
from mouse_cli.plots import BEFORE, Plot

_MOST = 25  # bars, where places have no positions in a row


def draw(found: Diagnosis, axes: Any) -> bool:
    """Share of each element along the longest direction of the structure; bars of the largest where there is no geometry."""
    energy = found.energy
    if energy is None:
        return False
    axes.set_ylabel("share of the energy, per cent")
    share = 100 * energy.share
    if len(energy.sites) > 1 and all(site.position is not None for site in energy.sites):
        at = np.array([site.position for site in energy.sites], dtype=float)
        axis = int(np.argmax(np.ptp(at, axis=0)))
        order = np.argsort(at[:, axis], kind="stable")
        axes.vlines(at[order, axis], 0, share[order], color=BEFORE, linewidth=1.0)
        axes.plot(at[order, axis], share[order], "o", markersize=3, color="black")
        axes.set_xlabel(f"{'xyz'[axis]}, m")
        return True
    shown = energy.order[:_MOST]
    axes.bar([" - ".join(map(str, energy.sites[i].ids)) for i in shown], share[shown], color=BEFORE)
    axes.tick_params(axis="x", labelrotation=90 if len(shown) > 6 else 0)
    axes.grid(axis="x", visible=False)
    return True


PLOT = Plot("energy", 25, "Energy by which stresses and strains disagree", draw)
