"""The properties that a method revised, and the bounds of their errors."""

from collections.abc import Iterator

import numpy as np

from mouse_cli.model.updated import Updated
from mouse_cli.report.blocks import Block, Column, Table, Text
from mouse_cli.report.section import RESULT, Options, Section
from mouse_cli.report.sections._wording import LEFT, counted

_COLUMNS = (
    Column("property", align=LEFT, literal=True),
    Column("unit", align=LEFT, literal=True),
    Column("before"),
    Column("after"),
    Column("change", "per cent"),
)


def properties(found: Updated, options: Options) -> Iterator[Block]:
    """One line a property; nothing for methods that revise a matrix."""
    if not found.moved:
        return
    rows = [
        (m.name, m.unit, m.before, m.after, 100 * (m.after / m.before - 1) if m.before else None) for m in found.moved
    ]
    yield Table(_COLUMNS, tuple(rows[: options.elements])).without_empty_columns()
    if len(rows) > options.elements:
        yield Text(f"{counted(len(rows) - options.elements, 'further property', 'further properties')}: see --json.")
    bounds = found.conditioning
    if bounds is not None:
        kappa = "is {}" if np.isfinite(bounds.condition) else "is infinite: some combination is not determined"
        values = (bounds.condition,) if np.isfinite(bounds.condition) else ()
        yield Text(f"The condition number of the least-squares equations {kappa}.", values)
        if np.isfinite(bounds.data) and np.isfinite(bounds.sensitivities):
            yield Text(
                "An error of their right side is at most {} times as large, relative, in the answer, and one of their "
                "coefficients {} times.",
                (bounds.data, bounds.sensitivities),
            )


SECTION = Section("update-properties", 40, "Revised properties", properties, (Updated,), place=RESULT)
