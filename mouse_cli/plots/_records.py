"""What figures of a held-out record share: models with their colours, the name of the output, the legend."""

from collections.abc import Iterator
from typing import Any

import numpy as np

from mouse_cli.model.record_diagnosis import WITH_CAUSE, RecordDiagnosis, Trace
from mouse_cli.model.record_update import RecordUpdate
from mouse_cli.plots import AFTER, BEFORE


def models(found: RecordDiagnosis | RecordUpdate) -> Iterator[tuple[str, str, np.ndarray]]:
    """Name, colour and simulated output (t,) of each model."""
    for name, values in found.trace.simulated.items():
        yield (found.after, AFTER, values) if name == WITH_CAUSE else (name, BEFORE, values)


def quantity(shown: Trace) -> str:
    """The output and its unit."""
    return f"{shown.title}{f', {shown.unit}' if shown.unit else ''}"


def legend(axes: Any) -> None:
    """Above the axes."""
    axes.legend(loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=4, borderaxespad=0.1)
