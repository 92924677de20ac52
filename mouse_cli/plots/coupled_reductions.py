"""What truncation makes of the frequencies of coupled structures: the error of the worst by the number of modes kept."""

from typing import Any

import numpy as np

from mouse_cli.model.coupled import Coupled
from mouse_cli.plots import Plot

_FLOOR = 1e-12  # what a logarithmic axis shows of an error that is rounding


def draw(found: Coupled, axes: Any) -> bool:
    """One line a method, logarithmic."""
    if found.modes is None or not found.modes.reduced:
        return False
    for method in dict.fromkeys(each.method for each in found.modes.reduced):
        own = [each for each in found.modes.reduced if each.method == method]
        error = [100 * max(float(np.abs(each.error[found.modes.rigid :]).max(initial=0.0)), _FLOOR) for each in own]
        axes.semilogy([each.keep for each in own], error, marker="o", ms=3.5, lw=1.0, label=method)
    axes.set_xlabel("modes kept of every part")
    axes.set_ylabel("error of the worst frequency, per cent")
    axes.legend(loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=4, borderaxespad=0.1)
    return True


PLOT = Plot("coupled-reductions", 20, "Error of truncation", draw, (Coupled,))
