"""Places along bars where something gives way in bending."""

from collections.abc import Callable

import numpy as np

from mouse_cli.diagnosis.candidates import Candidate
from mouse_cli.diagnosis.change import Change, Recipe, Unknown, product
from mouse_cli.diagnosis.reduced import Reduced


def places(
    model: Reduced,
    candidate: Candidate,
    sizes: tuple[Unknown, ...],
    added: Callable[[int, float, np.ndarray], np.ndarray],
    starts: np.ndarray,
) -> list[Recipe]:
    """A recipe for each line of bars: `added` (bar, share of its length, values of `sizes`) comes to the flexibility (2, 2)."""
    if model.bars is None:
        return []
    bars, total = model.bars, sum(line.length for line in model.bars.lines)
    found = []
    for line in bars.lines:
        where = Unknown("place", "m", 0.0, line.length, log=False)
        count = max(2, min(15, len(line.members)))
        at = (np.arange(count) + 0.5) / count * line.length

        def change(values: np.ndarray, line=line) -> Change:
            bar, share = line.at(values[-1])
            return Change(K=bars.softened(np.array([bar]), added(bar, share, values[:-1])[None]))

        def site(values: np.ndarray, line=line):
            return line.site(values[-1])

        found.append(
            Recipe(
                candidate,
                (*sizes, where),
                change,
                product(starts, at),
                site,
                log_prior=float(np.log(line.length / total)),
            )
        )
    return found
