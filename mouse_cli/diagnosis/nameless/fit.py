"""Every rival without a name fitted to the data, its spread and its correlation length integrated out."""

from dataclasses import replace

import numpy as np

from mouse_cli.diagnosis.likelihoods.modal.model import Model
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.nameless import Nameless, registry
from mouse_cli.diagnosis.nameless._cells import Cells
from mouse_cli.diagnosis.nameless._field import LENGTHS, fielded, found, smooth
from mouse_cli.diagnosis.search.fit import Fit, fit
from mouse_cli.model.diagnosis import Field, HeldOut
from mouse_cli.model.problem import Problem

_STEPS = 25  # of a fit


def rivals(base: Reduced, start: Fit, kind: type[Model] = Model) -> list[Fit]:
    """The best fit of each kind of field, in the coordinates `base`; its evidence is that of all spreads and lengths together."""
    fits = [_integrated(base, start, rival, cells, kind) for rival, cells in _sites(base)]
    return [one for one in fits if one is not None]


def as_field(one: Fit, log_evidence_over_named: float, held: HeldOut | None) -> Field:
    """The field of a fit in words and numbers."""
    base = one.model.base
    return found(
        base, one.point.x[: one.model.k], one.covariance[: one.model.k, : one.model.k], log_evidence_over_named, held
    )


def extended(problem: Problem, one: Fit) -> Problem | None:
    """The deck with the field of a fit in it, a parameter for each of its cells; None where a deck cannot hold it."""
    base, field = one.model.base, one.nameless
    if field.cells.extend is None:
        return None
    return field.cells.extend(problem, field.values(one.point.x[base.deck : one.model.k]), field.spread)


def _sites(base: Reduced) -> list[tuple[Nameless, Cells]]:
    every = [(rival, rival.cells(base)) for rival in registry().values()]
    return [(rival, cells) for rival, cells in every if cells is not None]


def _integrated(base: Reduced, start: Fit, rival: Nameless, cells: Cells, kind: type[Model]) -> Fit | None:
    fits: list[Fit] = []
    grid = [(spread, share) for share in LENGTHS for spread in rival.spreads]
    for spread, share in grid:
        model = fielded(base, smooth(rival, cells, spread, share))
        x = np.append(start.point.x[: start.model.k], np.zeros(len(model.of_field)))
        one = fit(kind(model), np.zeros(0), x, _STEPS)
        fits += [] if one is None else [one]
    if not fits:
        return None
    best = max(fits, key=lambda one: one.log_evidence)
    total = np.logaddexp.reduce([one.log_evidence for one in fits]) - np.log(len(grid))
    return replace(best, log_evidence=float(total))
