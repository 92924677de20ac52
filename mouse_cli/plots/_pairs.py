"""Bars side by side: errors of the model as it is and of the extended one."""

from typing import Any

import numpy as np

from mouse_cli.model.diagnosis import Diagnosis
from mouse_cli.plots import AFTER, BEFORE
from mouse_cli.report.sections._diagnosis_wording import with_cause

_COLOURS = BEFORE, AFTER
_SHORT, _MANY = 14, 8  # characters, labels up to which bars stand upright and names are in full size


def names(found: Diagnosis) -> tuple[str, str]:
    """Of both models."""
    return "model as it is", with_cause(found)


def pairs(axes: Any, labels: list[str], errors: list[np.ndarray], sd: np.ndarray, names: tuple[str, str]) -> None:
    """errors: (k,) of each model in per cent, sd (k,) of the last one or of the measurement, for k labels; names of the models.

    Long labels stand beside bars that lie.
    """
    at, width = np.arange(len(labels)), 0.8 / len(errors)
    lying = len(labels) > _MANY or max(map(len, labels)) > _SHORT
    bars, spreads = (axes.barh, "xerr") if lying else (axes.bar, "yerr")
    for i, error in enumerate(errors):
        place = at + (i - (len(errors) - 1) / 2) * width
        spread = sd if i == len(errors) - 1 else None
        style = {"color": _COLOURS[i], "label": names[i], "capsize": 2, "error_kw": {"linewidth": 0.8}}
        bars(place, error, width, **{spreads: spread}, **style)
    value = "model minus test, per cent"
    if lying:
        axes.axvline(0, color="black", linewidth=0.8)
        axes.set_yticks(at, labels, fontsize=8 if len(labels) <= _MANY else 6)
        axes.invert_yaxis()
        axes.grid(axis="y", visible=False)
        axes.set_xlabel(value)
    else:
        axes.axhline(0, color="black", linewidth=0.8)
        axes.set_xticks(at, labels)
        axes.grid(axis="x", visible=False)
        axes.set_ylabel(value)
    axes.legend(loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=2)
