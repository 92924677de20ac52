"""Of an answer in JSON: MAC of measured shapes and those of the revised model."""

from typing import Any

import numpy as np

from mouse_cli.dynamics.correlation import mac
from mouse_cli.plots import Plot
from mouse_cli.plots._answers import MOST, update
from mouse_cli.report.reading import Part, columns

_WRITTEN = 12  # modes up to which each square holds its number
_DARK = 0.55  # above which letters are white


def draw(document: Part, axes: Any) -> bool:
    """Rows are measured modes, columns the paired modes of the model."""
    found = update(document)
    components = found.parts("shapes") if found else []
    modes = list(dict.fromkeys(c.label("mode") for c in components))[:MOST]
    components = [c for c in components if c.label("mode") in modes]
    if not modes:
        return False
    matrix = mac(columns(components, modes, "test"), columns(components, modes, "revised"))
    axes.imshow(matrix, cmap="Blues", vmin=0, vmax=1)
    for i, k in np.ndindex(matrix.shape) if len(modes) <= _WRITTEN else ():
        colour = "white" if matrix[i, k] > _DARK else "black"
        axes.text(k, i, f"{matrix[i, k]:.2f}", ha="center", va="center", fontsize=7, color=colour)
    axes.set_xticks(range(len(modes)), modes)
    axes.set_yticks(range(len(modes)), modes)
    axes.grid(visible=False)
    axes.set_xlabel("mode of the revised model")
    axes.set_ylabel("measured mode")
    return True


PLOT = Plot("answer-mac", 30, "MAC of test and revised model", draw, (Part,))
