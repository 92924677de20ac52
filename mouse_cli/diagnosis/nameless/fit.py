"""Every rival without a name fitted to the data, its spread and its correlation length integrated out."""

from collections import Counter
from dataclasses import dataclass, replace
from itertools import product

import numpy as np

from mouse_cli.diagnosis.likelihoods.modal.model import Model
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.nameless import Nameless, registry
from mouse_cli.diagnosis.nameless._averaged import averaged, mean_values, signed, values_of_other
from mouse_cli.diagnosis.nameless._cells import FEWEST, Cells
from mouse_cli.diagnosis.nameless._field import LENGTHS, MOTIONS, Smooth, fielded, smooth
from mouse_cli.diagnosis.nameless._tied import tied
from mouse_cli.diagnosis.nameless.local import best_law
from mouse_cli.diagnosis.nameless.spring import best_spring
from mouse_cli.diagnosis.search.fit import Fit, fit
from mouse_cli.diagnosis.search.optima import NEAR, within
from mouse_cli.model.diagnosis import Field, FieldValue, HeldOut
from mouse_cli.model.field import SHOWN
from mouse_cli.model.problem import Problem
from mouse_cli.model.site import as_read

_STEPS, _TRIED = 25, 3  # of a fit; starts of a change of rank one


def rivals(base: Reduced, start: Fit, kind: type[Model] = Model, reach: float = np.inf) -> list[Fit]:
    """The best fit of each kind of field, in the coordinates `base`; its evidence is that of all spreads and lengths together.

    reach: misfit above which no fit matters.
    """
    fits = [_integrated(base, start, field, kind, reach) for field in _spreads(base)]
    local = [best_law(base, reach), best_spring(base, reach)] if kind is Model else []
    return [one for one in (*fits, *local) if one is not None]


def field_of(ranking, one: Fit, held: HeldOut | None = None) -> Field:
    """The field of a fit of a ranking in words and numbers, beside all that has a name there; of two that which is shown first."""
    odds = {id(each): float(value) for each, value in zip(ranking.fits, ranking.log_odds, strict=True)}
    named = max(odds[id(ranking.fits[i])] for i in ranking.named)
    over, other = odds[id(one)] - named, getattr(one.model.base, "other", None)
    own, beside = mean_values(one), other and values_of_other(one)
    each = [_in_words(one.nameless, *own, over), beside and _in_words(other.nameless, *beside, over)]
    first, second = each[::-1] if beside and _shown(*beside) and not _shown(*own) else each
    return replace(first, held_out=held, beside=second)


def significant(one: Fit) -> bool:
    """Whether a value of the field of a fit, or of that beside it, differs from 0 by more than two standard deviations."""
    beside = hasattr(one.model.base, "other") and _shown(*values_of_other(one))
    return beside or _shown(*mean_values(one))


def _shown(values: np.ndarray, sd: np.ndarray) -> bool:
    """Whether any of values (c,) differs from 0 by so much."""
    return bool((np.abs(values) > SHOWN * sd).any())


def _in_words(field: Smooth, values: np.ndarray, sd: np.ndarray, over: float) -> Field:
    """A field by its values (c,), their sd and its log evidence over all that has a name; each place once, though a bar that
    bends in two planes has a cell in each, of one value.
    """
    found: dict[tuple, FieldValue] = {}
    for site, value, own in zip(field.cells.sites, values.tolist(), sd.tolist(), strict=True):
        found.setdefault((*as_read((site,)), f"{value:.6e}"), FieldValue(site, value, own))
    sites = tuple(found.values())
    return Field(field.rival.property, sites, field.spread, field.length, field.cells.unit, over)


def extended(problem: Problem, one: Fit) -> Problem | None:
    """The deck with the field of a fit in it, a parameter for each of its cells; None where none can hold it."""
    base, x = one.model.base.first, one.point.x
    other = getattr(base, "other", None)
    count = one.nameless.P.shape[1]
    deck = _with(problem, one.nameless, x[base.deck :][:count])
    return deck if deck is None or other is None else _with(deck, other.nameless, x[base.deck + count :])


def _with(problem: Problem, field: Smooth, w: np.ndarray) -> Problem | None:
    """The deck with one field, its unknowns first in `w`."""
    if field.cells.extend is None:
        return None
    values = field.values(w[: field.P.shape[1]])
    return field.cells.extend(problem, values, field.spread, *((field.sign,) if field.sign else ()))


@dataclass(frozen=True)
class Spread:
    """A rival and its cells in every configuration of `base` (a,), None where it does not act."""

    rival: Nameless
    cells: tuple[Cells | None, ...]

    def over(self, base, spread: float, share: float, sign: int):
        """`base` with the field in it, of that spread and length; sign: of a change of rank one, else 0."""
        field, own = smooth(self.rival, next(filter(None, self.cells)), spread, share, sign), iter(self.cells)
        put = tied if sign else fielded
        return base.each(lambda part, has: put(part, field, next(own)))

    @property
    def grid(self) -> list[tuple[float, float, int]]:
        """Spreads, correlation lengths and signs that are integrated over."""
        lengths = MOTIONS if self.rival.signs else LENGTHS
        return list(product(self.rival.spreads, lengths, self.rival.signs or (0,)))


def _spreads(base) -> list[Spread]:
    """Of each rival that acts somewhere, over the cells that all configurations share in which it can act."""
    found = []
    for rival in registry().values():
        cells: list[Cells | None] = []
        base.each(
            lambda part, has, rival=rival, cells=cells: (cells.append(rival.cells(part) if has else None), part)[1]
        )
        shared = _shared(cells)
        if any(shared):
            found.append(Spread(rival, shared))
    return found


def _shared(cells: list[Cells | None]) -> tuple[Cells | None, ...]:
    """Those of the same sites: a configuration may lack parts, or hold still what moves in another."""
    own = [_places(each) for each in cells if each]
    common = [key for key in (own[0] if own else {}) if all(key in each for each in own)]
    if len(common) < FEWEST:
        return (None,) * len(cells)
    places = iter(own)
    return tuple(each and _some(each, [at[key] for at in [next(places)] for key in common]) for each in cells)


def _some(cells: Cells, kept: list[int]) -> Cells:
    return cells if kept == list(range(len(cells))) else cells.some(np.array(kept))


def _places(cells: Cells) -> dict[tuple, int]:
    """Index of each cell by its site, and by which of the cells there it is: an element bends in two planes."""
    seen: Counter = Counter()
    found = {}
    for i, site in enumerate(cells.sites):
        key = (site.kind, site.ids)
        found[(*key, seen[key])] = i
        seen[key] += 1
    return found


def _integrated(base, start: Fit, field: Spread, kind: type[Model], reach: float) -> Fit | None:
    fits: list[Fit] = []
    before: dict[tuple[float, int], np.ndarray] = {}  # the end of the fit with the spread below
    for spread, share, sign in field.grid:
        model = kind(field.over(base, spread, share, sign))
        found: list[Fit] = []
        for x in _starts(model, start, sign, before.get((share, sign))):
            one = fit(model, np.zeros(0), x, _STEPS, min(reach, within(found, NEAR)) if found else reach)
            found += [] if one is None else [signed(one)]
        ended = sorted(found, key=lambda one: -one.log_evidence)[:1]
        before.update(((share, sign), _values(one)) for one in ended)
        fits += ended
    if not fits:
        return None
    total = np.logaddexp.reduce([one.log_evidence for one in fits]) - np.log(len(field.grid))
    twice = np.log(2) if field.rival.signs else 0.0  # b and -b are the same
    return averaged(fits, [one.log_evidence for one in fits], total + twice)


def _values(one: Fit) -> np.ndarray:
    """Unknowns of a field (w,) for a spread of one, after those of the deck (k,)."""
    x, k = one.point.x.copy(), one.model.base.first.deck
    x[k:] *= one.nameless.spread
    return x


def _starts(model: Model, start: Fit, sign: int, before: np.ndarray | None) -> list[np.ndarray]:
    """Where to begin: without the field; of a change of rank one, which has no slope there, from the best of its components.

    before: `_values` of a fit with another spread, from where such a change begins too.
    """
    known = start.point.x[: start.model.k]
    count = model.base.L.shape[1] - len(known)
    if not sign:
        return [np.append(known, np.zeros(count))]
    points = [model.point(np.append(known, w)) for w in np.eye(count)]
    found = [at.x for at in sorted((at for at in points if at is not None), key=lambda at: at.chi2)[:_TRIED]]
    if before is not None:
        spread = model.base.nameless.spread
        found.insert(0, np.append(before[: len(known)], before[len(known) :] / spread))
    return found
