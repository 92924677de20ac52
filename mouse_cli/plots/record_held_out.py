"""A stretch of a record that no fit has seen: measured, and simulated by both models."""

from typing import Any

from mouse_cli.model.diagnosis import Diagnosis
from mouse_cli.model.record_diagnosis import WITH_CAUSE, RecordDiagnosis
from mouse_cli.plots import AFTER, BEFORE, Plot


def draw(found: Diagnosis, axes: Any) -> bool:
    """Lines over time."""
    if not isinstance(found, RecordDiagnosis) or found.trace is None:
        return False
    shown = found.trace
    axes.plot(shown.time_s, shown.measured, color="black", linewidth=1.2, label="measured")
    for name, values in shown.simulated.items():
        color = AFTER if name == WITH_CAUSE else BEFORE
        axes.plot(shown.time_s, values, "--", color=color, linewidth=1.0, label=f"simulated, {name}")
    axes.set_xlabel("time, s")
    axes.set_ylabel(f"{shown.title}{f', {shown.unit}' if shown.unit else ''}")
    axes.legend(loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=3, borderaxespad=0.1)
    return True


PLOT = Plot("record-held-out", 55, "Held-out record", draw)
