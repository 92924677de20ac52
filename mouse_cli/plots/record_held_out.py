"""A stretch of a record that no fit has seen: measured, and simulated by both models."""

from typing import Any

from mouse_cli.model.record_diagnosis import RecordDiagnosis
from mouse_cli.model.record_update import RecordUpdate
from mouse_cli.plots import Plot
from mouse_cli.plots._records import legend, models, quantity


def draw(found: RecordDiagnosis | RecordUpdate, axes: Any) -> bool:
    """Lines over time."""
    shown = found.trace
    if shown is None:
        return False
    axes.plot(shown.time_s, shown.measured, color="black", linewidth=1.2, label="measured")
    for name, colour, values in models(found):
        axes.plot(shown.time_s, values, "--", color=colour, linewidth=1.0, label=f"simulated, {name}")
    axes.set_xlabel("time, s")
    axes.set_ylabel(quantity(shown))
    legend(axes)
    return True


PLOT = Plot("record-held-out", 55, "Held-out record", draw, (RecordDiagnosis, RecordUpdate))
