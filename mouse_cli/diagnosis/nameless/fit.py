"""Every rival without a name fitted to the data, its spread and its correlation length integrated out."""

from dataclasses import dataclass, replace

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
    fits = [_integrated(base, start, field, kind) for field in _spreads(base)]
    return [one for one in fits if one is not None]


def field_of(ranking, one: Fit, held: HeldOut | None = None) -> Field:
    """The field of a fit of a ranking in words and numbers, beside all that has a name there."""
    odds = {id(each): float(value) for each, value in zip(ranking.fits, ranking.log_odds, strict=True)}
    named = max(odds[id(ranking.fits[i])] for i in ranking.named)
    base = one.model.base.first
    k = one.model.k
    return found(base, one.point.x[:k], one.covariance[:k, :k], odds[id(one)] - named, held)


def extended(problem: Problem, one: Fit) -> Problem | None:
    """The deck with the field of a fit in it, a parameter for each of its cells; None where a deck cannot hold it."""
    base, field = one.model.base, one.nameless
    if field.cells.extend is None:
        return None
    return field.cells.extend(problem, field.values(one.point.x[base.deck : one.model.k]), field.spread)


@dataclass(frozen=True)
class Spread:
    """A rival and its cells in every configuration of `base` (a,), None where it does not act."""

    rival: Nameless
    cells: tuple[Cells | None, ...]

    def over(self, base, spread: float, share: float):
        """`base` with the field in it, of that spread and length."""
        field = smooth(self.rival, next(filter(None, self.cells)), spread, share)
        own = iter(self.cells)
        return base.each(lambda part, has: fielded(part, field, next(own)))


def _spreads(base) -> list[Spread]:
    """Those that have the same cells wherever they act."""
    found = []
    for rival in registry().values():
        cells: list[Cells | None] = []

        def look(part: Reduced, has: bool, rival=rival, cells=cells) -> Reduced:
            cells.append(rival.cells(part) if has else None)
            return part

        base.each(look)
        sizes = {0 if own is None else len(own) for own, has in zip(cells, _having(base), strict=True) if has}
        if len(sizes) == 1 and sizes != {0}:
            found.append(Spread(rival, tuple(cells)))
    return found


def _having(base) -> list[bool]:
    found: list[bool] = []
    base.each(lambda part, has: found.append(has) or part)
    return found


def _integrated(base, start: Fit, field: Spread, kind: type[Model]) -> Fit | None:
    fits: list[Fit] = []
    grid = [(spread, share) for share in LENGTHS for spread in field.rival.spreads]
    for spread, share in grid:
        model = field.over(base, spread, share)
        known = start.point.x[: start.model.k]
        one = fit(kind(model), np.zeros(0), np.append(known, np.zeros(model.L.shape[1] - len(known))), _STEPS)
        fits += [] if one is None else [one]
    if not fits:
        return None
    best = max(fits, key=lambda one: one.log_evidence)
    total = np.logaddexp.reduce([one.log_evidence for one in fits]) - np.log(len(grid))
    return replace(best, log_evidence=float(total))
