"""Two rivals without a name at once: a field of one kind beside the most probable of another, which is fitted with it."""

from collections.abc import Sequence
from dataclasses import replace
from itertools import product

import numpy as np

from mouse_cli.diagnosis.likelihoods.modal.model import Model
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.nameless import registry
from mouse_cli.diagnosis.nameless._averaged import averaged, signed
from mouse_cli.diagnosis.nameless._both import both
from mouse_cli.diagnosis.nameless._cells import Cells
from mouse_cli.diagnosis.nameless._field import LENGTHS, Fielded, smooth
from mouse_cli.diagnosis.search.fit import Fit, fit
from mouse_cli.diagnosis.search.optima import NEAR, within

_STEPS = 25  # of a fit


def joint_rivals(model: Reduced, fits: Sequence[Fit]) -> list[Fit]:
    """Every kind of field beside each other rival among `fits`, but for laws, of which each mode has a model of its own.

    The evidence is the mean over the spreads and lengths of the field, times that of all spreads and sites of the other over that
    of its best. Those that misfit far more than others do not count.
    """
    others = [one for one in fits if one.nameless and type(one.model) is Model]
    found: list[Fit] = []
    tried: set[frozenset[str]] = set()
    for other in sorted(others, key=lambda one: -one.log_evidence):
        for key, rival in registry().items():
            cells = None if rival.signs else rival.cells(model)
            pair = frozenset((other.nameless.rival.key, key))
            if cells is not None and len(pair) == 2 and pair not in tried:
                tried.add(pair)
                one = _beside(model, other, key, cells, within([*fits, *found]))
                found += [] if one is None else [one]
    return found


def _beside(model: Reduced, other: Fit, key: str, cells: Cells, reach: float) -> Fit | None:
    """The field of rival `key` beside a fit, its spread and length integrated out."""
    rival, known = registry()[key], other.nameless.rival
    alone = replace(other.model.base, data=model.data)  # whose theory is not yet that of a mechanism
    of_both = replace(rival, key=f"{known.key} and {key}", parts=known.parts + rival.parts, even="", gradient="")
    grid, found = list(product(rival.spreads, LENGTHS)), []
    for spread, share in grid:
        trial = Model(both(alone, smooth(of_both, cells, spread, share), cells))
        start = _start(other.point.x, trial.base)
        one = fit(trial, np.zeros(0), start, _STEPS, min(reach, within(found, NEAR)) if found else reach)
        found += [] if one is None else [signed(one)]
    if not found:
        return None
    total = np.logaddexp.reduce([one.log_evidence for one in found]) - np.log(len(grid))
    here = fit(other.model, np.zeros(0), other.point.x)
    return averaged(found, [one.log_evidence for one in found], float(total + other.log_evidence - here.log_evidence))


def _start(x: np.ndarray, base: Fielded) -> np.ndarray:
    """The other as it was found, and none of the field."""
    return np.concatenate([x[: base.deck], np.zeros(len(base.of_field)), x[base.deck :]])
