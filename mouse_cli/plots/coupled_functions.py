"""Functions of coupled structures, with what noise of measured parts makes of them."""

from typing import Any

import numpy as np

from mouse_cli.model.coupled import Coupled
from mouse_cli.plots import Plot
from mouse_cli.plots._functions import decibels, ribbon

_MOST = 4  # functions in one figure


def draw(found: Coupled, axes: Any) -> bool:
    """Magnitudes in dB over frequency, bands of 95 per cent where the accuracy of the parts is known."""
    frf = found.functions
    if frf is None:
        return False
    for k, (o, i) in enumerate([(o, i) for i in range(frf.H.shape[2]) for o in range(frf.H.shape[1])][:_MOST]):
        H = frf.H[:, o, i]
        name = f"{frf.output_names[o]} / {frf.input_names[i]}"
        axes.plot(frf.frequency_hz, decibels(H), color=f"C{k}", lw=1.0, label=name)
        with np.errstate(divide="ignore", invalid="ignore"):
            ribbon(axes, frf.frequency_hz, decibels(H), np.sqrt(frf.variance[:, o, i] / 2) / np.abs(H), f"C{k}", 0.25)
    axes.set_xlabel("frequency, Hz")
    axes.set_ylabel(f"{frf.kind}, dB")
    axes.legend(loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=2, borderaxespad=0.1)
    return True


PLOT = Plot("coupled-functions", 10, "Functions of the whole", draw, (Coupled,))
