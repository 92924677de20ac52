"""Natural frequencies of coupled models, and what reductions of the parts make of them."""

from collections.abc import Iterator

import numpy as np

from mouse_cli.model.coupled import Coupled, CoupledModes
from mouse_cli.report.blocks import Block, Column, Table, Text
from mouse_cli.report.section import RESULT, Options, Section
from mouse_cli.report.sections._wording import LEFT, counted


def modes(found: Coupled, options: Options) -> Iterator[Block]:
    """Frequencies of the whole as assembled; then errors of reductions, one line a method and number of modes kept."""
    whole = found.modes
    if whole is None:
        return
    size = counted(whole.size, "degree of freedom", "degrees of freedom")
    rigid = counted(whole.rigid, "rigid-body mode") if whole.rigid else "no rigid-body mode"
    yield Text(f"The whole, assembled, has {size} and {rigid}.")
    yield Table(
        (Column("mode"), Column("frequency", "Hz")),
        tuple((i, float(hz)) for i, hz in enumerate(whole.frequencies_hz, 1)),
    )
    if whole.reduced:
        yield Text(
            "What truncation makes of them: error of each frequency, in per cent, with the stated number of modes kept of "
            "every part."
        )
        yield _errors(whole, options.short)


def _errors(whole: CoupledModes, short: bool) -> Table:
    """One line a reduction; short: with the worst mode alone."""
    elastic = [i for i in range(len(whole.frequencies_hz)) if i >= whole.rigid]
    columns = (
        Column("reduction", align=LEFT, literal=True),
        Column("kept"),
        Column("coordinates"),
        Column("worst", "per cent"),
    )
    columns += tuple(Column(f"mode {i + 1}", "per cent") for i in elastic)
    rows = []
    for each in whole.reduced:
        error = [float(100 * each.error[i]) for i in elastic]
        worst = float(np.abs(error).max()) if elastic else np.nan
        rows.append((each.method, each.keep, each.coordinates, worst, *error))
    shown = 4 if short else len(columns)
    return Table(columns[:shown], tuple(row[:shown] for row in rows), 3)


SECTION = Section("coupling-modes", 40, "Natural frequencies of the whole", modes, (Coupled,), place=RESULT)
