"""Figures of coupled and modified structures."""

from typing import Any

import numpy as np

from mouse_cli.model.coupled import Coupled
from mouse_cli.model.modified import Modified
from mouse_cli.plots import AFTER, BEFORE, Plot, labelled
from mouse_cli.plots._functions import decibels, ribbon

_MOST = 4  # functions in one figure


def coupled_functions(found: Coupled, axes: Any) -> bool:
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
    return labelled(axes, "frequency, Hz", f"{frf.kind}, dB", 2)


def modified_functions(found: Modified, axes: Any) -> bool:
    """The first function asked for: magnitude in dB, 95 per cent after the changes."""
    if found.functions is None:
        return False
    before, after = found.functions.before, found.functions.after
    axes.plot(before.frequency_hz, decibels(before.H[:, 0, 0]), color=BEFORE, lw=1.0, ls="--", label="before")
    ribbon(axes, after.frequency_hz, decibels(after.H[:, 0, 0]), found.functions.sd_log[:, 0, 0], AFTER, 0.25)
    axes.plot(after.frequency_hz, decibels(after.H[:, 0, 0]), color=AFTER, lw=1.0, label="after")
    return labelled(axes, "frequency, Hz", f"{after.kind} {after.output_names[0]} / {after.input_names[0]}, dB", 2)


_FLOOR = 1e-12  # what a logarithmic axis shows of an error that is rounding


def coupled_reductions(found: Coupled, axes: Any) -> bool:
    """What truncation makes of the frequencies of coupled structures: the error of the worst by the number of modes kept."""
    if found.modes is None or not found.modes.reduced:
        return False
    for method in dict.fromkeys(each.method for each in found.modes.reduced):
        own = [each for each in found.modes.reduced if each.method == method]
        error = [100 * max(float(np.abs(each.error[found.modes.rigid :]).max(initial=0.0)), _FLOOR) for each in own]
        axes.semilogy([each.keep for each in own], error, marker="o", ms=3.5, lw=1.0, label=method)
    return labelled(axes, "modes kept of every part", "error of the worst frequency, per cent", 4)


PLOTS = (
    Plot("coupled-functions", 10, "Functions of the whole", coupled_functions, (Coupled,)),
    Plot("modified-functions", 10, "A function before and after", modified_functions, (Modified,)),
    Plot("coupled-reductions", 20, "Error of truncation", coupled_reductions, (Coupled,)),
)
