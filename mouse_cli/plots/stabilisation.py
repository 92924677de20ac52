"""The stabilisation diagram: poles by order over the level of what was measured."""

from typing import Any

import numpy as np

from mouse_cli.model.identification import Identification
from mouse_cli.plots import AFTER, BEFORE, Plot


def draw(found: Identification, axes: Any) -> bool:
    """Stable poles filled, others as points; lines at identified modes; the level behind."""
    seen = found.diagram
    if not len(seen.order):
        return False
    if len(seen.line_hz):
        behind = axes.twinx()
        behind.semilogy(seen.line_hz, np.where(seen.level > 0, seen.level, np.nan), color=BEFORE, linewidth=0.7)
        behind.set_ylabel("root mean square of all channels")
        behind.grid(visible=False)
    other, stable = ~seen.stable, seen.stable
    axes.plot(seen.frequency_hz[other], seen.order[other], ".", color="0.6", markersize=2, label="pole")
    axes.plot(seen.frequency_hz[stable], seen.order[stable], "o", color=AFTER, markersize=3, label="stable pole")
    for hz in found.modes.frequency_hz:
        axes.axvline(hz, color="black", linewidth=0.7, linestyle="--")
    axes.set_xlim(*found.band_hz)
    axes.set_xlabel("frequency, Hz")
    axes.set_ylabel("order")
    axes.legend(loc="upper right")
    return True


PLOT = Plot("stabilisation", 110, "Stabilisation diagram", draw, (Identification,))
