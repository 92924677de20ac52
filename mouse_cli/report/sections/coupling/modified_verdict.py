"""Changes in brief: whether the targets can be met, which mode moves most, and best locations."""

from collections.abc import Iterator
from itertools import groupby

import numpy as np

from mouse_cli.model.modified import Modified
from mouse_cli.report.blocks import Block, Text
from mouse_cli.report.section import VERDICT, Options, Section


def verdict(found: Modified, options: Options) -> Iterator[Block]:
    """Targets first, then the largest shift."""
    for target, needs in groupby(found.needs, key=lambda need: need.target):
        met = [need.place for need in needs if np.isfinite(need.value)]
        where = (
            f"can be met: {len(met)} places for it" if len(met) > 1 else f"can be met at {met[0]} alone" if met else ""
        )
        yield Text(
            f"Mode {target.mode} {target.side} {target.hz:g} Hz by a {target.means} {where or 'cannot be met at any place'}."
        )
    shift = found.shifts.shift_hz
    if found.connections and np.isfinite(shift).any():
        i = int(np.nanargmax(np.abs(shift)))
        yield Text(
            f"The changes move mode {i + 1} most, by {{}} Hz (sd {{}}) to {{}} Hz.",
            (float(shift[i]), float(found.shifts.sd_hz[i]), float(found.after.frequencies_hz[i])),
        )
    for each in found.swept:
        if each.places:
            yield Text(f"A {each.sweep.means} does most for mode {each.sweep.mode} at {each.places[0].name}.")
    if not (found.connections or found.needs or found.swept):
        yield Text("Nothing is changed.")


SECTION = Section("modified-verdict", 10, "Modified structure", verdict, (Modified,), place=VERDICT)
