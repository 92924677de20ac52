"""Natural frequencies before and after changes, and how uncertain their shifts are."""

from collections.abc import Iterator

import numpy as np

from mouse_cli.model.modified import Modified
from mouse_cli.report.blocks import Block, Column, Matrix, Table, Text
from mouse_cli.report.section import RESULT, Options, Section

_CORRELATED = 10  # modes whose correlations are shown


def frequencies(found: Modified, options: Options) -> Iterator[Block]:
    """One line a mode after the changes, beside the one that it came from."""
    before, after, shifts = found.before, found.after, found.shifts
    columns = (
        Column("mode"), Column("frequency", "Hz"), Column("standard deviation", "Hz"), Column("was mode"), Column("at", "Hz"),
        Column("with sd", "Hz"), Column("shift", "Hz", digits=4), Column("sd of the shift", "Hz", digits=3),
        Column("MAC", digits=4),
    )  # fmt: skip
    rows = []
    for i, hz in enumerate(after.frequencies_hz):
        j = int(shifts.partner[i])
        own = (i + 1, float(hz) if i >= after.rigid_modes else 0.0, float(after.sd_hz[i]))
        if j < 0:
            rows.append((*own, None, None, None, None, None, None))
            continue
        was = float(before.frequencies_hz[j]) if j >= before.rigid_modes else 0.0
        rows.append(
            (
                *own,
                j + 1,
                was,
                float(before.sd_hz[j]),
                float(shifts.shift_hz[i]),
                float(shifts.sd_hz[i]),
                float(shifts.mac[i]),
            )
        )
    yield Table(columns, tuple(rows))
    if (shifts.partner < 0).any():
        yield Text(
            "A mode without a number before is new, such as that of an absorber, or unlike all that were looked at."
        )
    if found.modification.problem.parameters and not options.short:
        yield from _correlations(found)


def _correlations(found: Modified) -> Iterator[Block]:
    """Of the frequencies after the changes."""
    root = found.after.root_hz[found.after.rigid_modes :][:_CORRELATED]
    size = np.linalg.norm(root, axis=1)
    if len(root) < 2 or not (size > 0).all():
        return
    unit = root / size[:, None]
    labels = tuple(str(i) for i in range(found.after.rigid_modes + 1, found.after.rigid_modes + 1 + len(root)))
    yield Matrix(
        "Correlations of the frequencies after the changes", unit @ unit.T, labels, labels, corner=("mode", "mode")
    )


SECTION = Section("modified-frequencies", 20, "Natural frequencies", frequencies, (Modified,), place=RESULT)
