"""The table of identified modes."""

from collections.abc import Iterator

import numpy as np

from mouse_cli.model.identification import Identification
from mouse_cli.report.blocks import Block, Column, Table, Text
from mouse_cli.report.section import RESULT, Options, Section
from mouse_cli.report.sections._wording import LEFT

_COLUMNS = (
    Column("mode"),
    Column("frequency", "Hz"),
    Column("sd", "Hz"),
    Column("damping", "per cent"),
    Column("sd", "per cent"),
    Column("MPC"),
    Column("stable in", "orders"),
    Column("lines in bandwidth"),
    Column("error of fit", "per cent"),
    Column("scale", align=LEFT),
)


def modes(found: Identification, options: Options) -> Iterator[Block]:
    """One line a mode."""
    each = found.modes
    if not each.m:
        return
    measured = np.isfinite(each.error)
    rows = [
        (
            r + 1,
            float(each.frequency_hz[r]),
            float(each.frequency_sd_hz[r]),
            100 * float(each.damping[r]),
            100 * float(each.damping_sd[r]),
            float(each.mpc[r]),
            int(each.stable_orders[r]),
            float(each.lines[r]) if measured[r] else None,
            100 * float(each.error[r]),
            each.scale[r],
        )
        for r in range(each.m)
    ]
    yield Table(_COLUMNS, tuple(rows)).without_empty_columns()
    yield Text(
        "Frequency is |lambda| / 2 pi, damping -Re lambda / |lambda|. MPC, modal phase collinearity, is 1 for a real shape. "
        "The error of fit is that near the resonance, by what was measured there."
    )


SECTION = Section("identification-modes", 20, "Modes", modes, (Identification,), place=RESULT)
