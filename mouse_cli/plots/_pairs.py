"""Bars side by side: errors of the model as it is and of the extended one."""

from typing import Any

import numpy as np

from mouse_cli.plots import AFTER, BEFORE

_NAMES, _COLOURS = ("model as it is", "extended model"), (BEFORE, AFTER)


def pairs(axes: Any, labels: list[str], errors: list[np.ndarray], sd: np.ndarray) -> None:
    """errors: (k,) of each model in per cent, sd (k,) of the last one or of the measurement, for k labels."""
    at, width = np.arange(len(labels)), 0.8 / len(errors)
    for i, error in enumerate(errors):
        place = at + (i - (len(errors) - 1) / 2) * width
        spread = sd if i == len(errors) - 1 else None
        axes.bar(
            place, error, width, yerr=spread, color=_COLOURS[i], label=_NAMES[i], capsize=2, error_kw={"linewidth": 0.8}
        )
    axes.axhline(0, color="black", linewidth=0.8)
    axes.set_xticks(at, labels, rotation=90 if len(labels) > 8 or max(map(len, labels)) > 14 else 0)
    axes.grid(axis="x", visible=False)
    axes.set_ylabel("model minus test, per cent")
    axes.legend()
