"""A function before and after changes, with the band that the uncertainty of the properties gives it."""

from typing import Any

from mouse_cli.model.modified import Modified
from mouse_cli.plots import AFTER, BEFORE, Plot
from mouse_cli.plots._functions import decibels, ribbon


def draw(found: Modified, axes: Any) -> bool:
    """The first function asked for: magnitude in dB, 95 per cent after the changes."""
    if found.functions is None:
        return False
    before, after = found.functions.before, found.functions.after
    axes.plot(before.frequency_hz, decibels(before.H[:, 0, 0]), color=BEFORE, lw=1.0, ls="--", label="before")
    ribbon(axes, after.frequency_hz, decibels(after.H[:, 0, 0]), found.functions.sd_log[:, 0, 0], AFTER, 0.25)
    axes.plot(after.frequency_hz, decibels(after.H[:, 0, 0]), color=AFTER, lw=1.0, label="after")
    axes.set_xlabel("frequency, Hz")
    axes.set_ylabel(f"{after.kind} {after.output_names[0]} / {after.input_names[0]}, dB")
    axes.legend(loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=2, borderaxespad=0.1)
    return True


PLOT = Plot("modified-functions", 10, "A function before and after", draw, (Modified,))
