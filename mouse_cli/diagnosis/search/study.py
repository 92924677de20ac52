"""The most probable fit of a cause: a first look at all places and sizes, descents from the best, and what ends them too soon."""

from dataclasses import replace
from functools import cached_property

import numpy as np

from mouse_cli.diagnosis.effects.change import Recipe
from mouse_cli.diagnosis.likelihoods.modal.lowest import lowest
from mouse_cli.diagnosis.likelihoods.modal.model import Model
from mouse_cli.diagnosis.likelihoods.modal.point import Point
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.likelihoods.modal.unseen import unseen
from mouse_cli.diagnosis.mechanisms import Candidate, registry
from mouse_cli.diagnosis.search.escape import shifted, uncrossed
from mouse_cli.diagnosis.search.fit import MOST, End, Fit, descended, fit
from mouse_cli.diagnosis.search.optima import NEAR, distinct, within
from mouse_cli.diagnosis.search.starts import cost, leading, spread
from mouse_cli.dynamics.eigen import IndefiniteError

_STARTS = 3  # fits of a candidate to the end, from different optima
_LOOKS, _MOST, _BRIEF = 12, 40, 4  # brief descents at least, at most, and their steps
_WEIGHED = 12  # ends of brief descents that are weighed in all coordinates
_SLACK = 1.5  # times the misfit that matters in all coordinates: what matters in few
_TIED, _TIES = 6.0, 8  # misfit above the best up to which other places are as good, and how many of them are fitted
_SETTLE, _MOVED = 3, 5e-3  # times that causes are weighed anew, as long as parameters move more than that share
_ABOUT = 4  # studies at other parameters that are kept
_FEW = 16  # places and sizes that are looked at in all coordinates
_COARSE = 24  # coordinates at least for a first look


class Study:
    """A reduced model, what each candidate can do to it, and the same at other parameters, where causes weigh otherwise.

    known: candidates by key; None: all. kind: of what a model with causes is made, of one structure or of its arrangements.
    """

    def __init__(self, model: Reduced, known: dict[str, Candidate] | None = None, kind: type[Model] = Model):
        self.model, self.k, self.kind = model, model.L.shape[1], kind
        self.known = registry() if known is None else known
        self._made: dict[str, list[Recipe]] = {}
        self._about: list[Study] = [self]
        self._looked: dict[tuple, list[tuple[float, int, np.ndarray]]] = {}

    def recipes(self, name: str) -> list[Recipe]:
        """What candidate `name` can do, and where; made when first asked for."""
        if name not in self._made:
            candidate = self.known[name]
            made = self.model.recipes(candidate)
            self._made[name] = [replace(recipe, number=i) for i, recipe in enumerate(made)]
        return self._made[name]

    @cached_property
    def coarse(self) -> "Study":
        """The same in few coordinates, in which all places and sizes are looked at before any is fitted.

        Those are the lowest, and how the rest bends when one end of a line gives way, which they alone do not.
        """
        model = self.model.looked_at(_lowest)
        return self if model is self.model else Study(model, self.known, self.kind)

    def promising(self) -> list[str]:
        """All candidates, those first that a first look at them alone finds most promising."""
        none = np.zeros(self.k)
        looks = {name: self.coarse.looks(name, none, ()) for name in self.known}
        return sorted(looks, key=lambda name: looks[name][0][0] if looks[name] else np.inf)

    def starts(self, name: str, before: np.ndarray, beside: tuple[Recipe, ...]) -> list[tuple[int, np.ndarray]]:
        """Numbers of recipes of candidate `name`, and x to begin from, the most promising first."""
        return [(number, x) for _, number, x in self.looks(name, before, beside)]

    def looks(self, name: str, before: np.ndarray, beside: tuple[Recipe, ...]) -> list[tuple[float, int, np.ndarray]]:
        """The same, with the misfits that are to be expected; kept, for what looks best is where descents begin."""
        others, found = self.own(beside), []
        key = (name, before.tobytes(), *((each.candidate.key, each.number) for each in others))
        if key in self._looked:
            return self._looked[key]
        for recipe in self.recipes(name):
            trial = self.kind(self.model, (*others, recipe))
            for values in recipe.grid:
                at = trial.point(np.concatenate([before, recipe.coordinates(values)]))
                if at is not None:
                    found.append((self.foreseen(at), recipe.number, at.x))
        found.sort(key=lambda item: item[0])
        self._looked[key] = found
        return found

    def approached(
        self, name: str, before: np.ndarray, beside: tuple[Recipe, ...], reach: float = np.inf
    ) -> list[tuple[float, int, list[np.ndarray]]]:
        """Misfit - 2 ln prior, number of the recipe, x at the end and the start of brief descents, the best first, no two alike.

        reach: misfit from which on none need go on. What a first look finds best may be beside the true place many times
        over, and the true one at a wrong size.
        """
        trials = {i: self.with_cause(beside, name, i) for i in range(len(self.recipes(name)))}
        most = min(max(_LOOKS, len(trials)), _MOST) // (2 if beside else 1)  # a partner is tried beside many
        chosen = spread(self.starts(name, before, beside), trials, most)
        if len(chosen) < 2:
            return [(0.0, i, [x]) for i, x in chosen]
        led: list[tuple[int, np.ndarray, End]] = []
        for i, x in chosen:  # so many are weighed at most, and one that cannot be among these is given up
            last = cost(led[_weighed_beside(beside) - 1][2]) if len(led) >= _weighed_beside(beside) else np.inf
            limit = last + 2 * sum(recipe.log_prior for recipe in trials[i].recipes)
            end = descended(trials[i], x[self.k :], x[: self.k], _BRIEF, min(reach, limit))
            led = led if end is None else leading(led, (i, x, end))
        kept = {id(end) for _, end in spread([(i, one.point.x) for i, _, one in led], trials, most)}
        return [(cost(one), i, [one.point.x, x]) for i, x, one in led if id(one.point.x) in kept]

    @cached_property
    def _adapted(self) -> tuple[np.ndarray, np.ndarray]:
        """T (q, k), and (T'T + I)^-1 [T', -I] (k, q + k): how far the deck's parameters follow a residual."""
        plain = self.kind(self.model)
        T = plain.jacobian(plain.point(np.zeros(self.k)))
        return T, np.linalg.solve(T.T @ T + np.eye(self.k), np.hstack([T.T, -np.eye(self.k)]))

    def foreseen(self, at: Point) -> float:
        """The misfit that is left of `at` when the deck's parameters adapt, to first order."""
        T, adapted = self._adapted
        step = adapted @ np.concatenate([at.residual, at.x[: self.k]])
        left, z = at.residual - T @ step, at.x[: self.k] + step
        return float(left @ left + z @ z)

    def own(self, recipes: tuple[Recipe, ...]) -> tuple[Recipe, ...]:
        """The same causes at the same places in this model, which may count places otherwise."""
        return tuple(self._same(recipe) for recipe in recipes)

    def _same(self, recipe: Recipe) -> Recipe:
        made, text = self.recipes(recipe.candidate.key), recipe.site(recipe.grid[0]).text
        order = sorted(made, key=lambda each: each.number != recipe.number)
        return next((each for each in order if each.site(each.grid[0]).text == text), order[0])

    def with_cause(self, others: tuple[Recipe, ...], name: str, number: int) -> Model:
        """The model with the causes `others`, from any study, and recipe `number` of candidate `name`."""
        return self.kind(self.model, (*self.own(others), self.recipes(name)[number]))

    def at(self, one: Fit) -> "Study":
        """The same at the parameters that a fit found, if these are of a structure."""
        theta = one.model.base.parameters(one.point.x[: self.k])
        try:
            return Study(self.model.at(theta), self.known, self.kind)
        except IndefiniteError:  # parameters far from their prior, of a fit that explains nothing
            return self

    def about(self, one: Fit) -> "Study":
        """The same, or one of the last there were, at parameters from which those of a fit differ by no more than a trifle."""
        theta = one.model.base.parameters(one.point.x[: self.k])
        for study in self._about:
            if np.all(np.abs(theta - study.model.theta) <= _MOVED * np.abs(study.model.theta)):
                return study
        self._about = [self, self.at(one), *self._about[1:_ABOUT]]
        return self._about[1]


def _lowest(model: Reduced) -> Reduced:
    """A model in its lowest coordinates, and those by which ends of lines give way; itself where there are no more."""
    return lowest(model, max(_COARSE, 4 * model.data.m + 8, int(model.data.test.number.max()) + 12))


def _weighed_beside(others: tuple) -> int:
    """How many ends of brief descents are weighed in all coordinates, beside causes there already."""
    return _WEIGHED // (2 if others else 1)


def idealised(one: Fit) -> Fit:
    """The fit when the theory of its causes is right to some share of what they do."""
    loose = one.model.loosened(one.point, one.model.base.problem.theory.mechanism)
    return one if loose is None else fit(loose, one.c, one.point.x[: one.model.k]) or one


def settled(one: Fit, study: Study) -> Fit:
    """The fit with no modes crosswise, and its causes weighed at the parameters that it found, not where the search began."""
    one = uncrossed(one)
    for _ in range(_SETTLE):
        theta = one.model.base.parameters(one.point.x[: one.model.k])
        before = one.model.base.theta
        if not one.recipes or np.all(np.abs(theta - before) <= _MOVED * np.abs(before)):
            break
        there = study.at(one)
        base = there.model.judged_by(one.model.base.data)
        again = fit(study.kind(base, there.own(one.recipes)), one.c, one.point.x[: one.model.k])
        if again is None:
            break
        one = again
    return one


def best(study: Study, name: str, reach: float = np.inf) -> Fit | None:
    """The most probable fit of candidate `name` over all of its places, its evidence summed over distinct optima.

    reach: misfit above which no fit matters, and is left as it was found.
    """
    found = distinct(tried(study, name, None, _STARTS, reach=reach))
    return summed([settled(shifted(one), study) if one.misfit < reach else one for one in found], reach)


def tried(
    study: Study, name: str, beside: Fit | None, count: int, most: int = MOST, reach: float = np.inf
) -> list[Fit]:
    """Fits of candidate `name` from its `count` most promising places, in at most so many steps; beside: causes there already.

    Each first in the lowest coordinates, then in all; in all at once where there is little to look at, for what is spread over
    the structure, such as shear, is not to be had in few. reach: misfit above which none matters.
    """
    others = () if beside is None else beside.recipes
    before = np.zeros(study.k) if beside is None else beside.point.x
    first = study if sum(len(recipe.grid) for recipe in study.recipes(name)) <= _FEW else study.coarse
    near_by = first.approached(name, before, others, _SLACK * reach)
    tied = 0 if beside is not None or not near_by else sum(left < near_by[0][0] + _TIED for left, _, _ in near_by)
    count = max(count, min(tied, _TIES))
    chosen = near_by[:count] if first is study else _weighed(study, others, name, near_by, count)
    ways = [(first, *each) for each in chosen] + (
        [] if others else [(study, *each) for each in _screened(study, name, reach)]
    )
    found: list[Fit] = []
    for way, _, i, x in ways:
        least = min(reach, within(found, NEAR)) if found and others else reach  # beside others the best alone is kept
        one = _ended(study, way, others, name, i, x, most, least)
        found += [] if one is None else [one]
    return found


def _screened(study: Study, name: str, reach: float) -> list[tuple[float, int, list[np.ndarray]]]:
    """Likewise from where a screening of the candidate's own puts its recipes, in all coordinates: the best, and those as good.

    A screening pairs modes by their shapes, where those of a wrong size misfit more than those of a wrong place.
    """
    none, ends = np.zeros(study.k), []
    for recipe in study.recipes(name):
        trial = study.with_cause((), name, recipe.number)
        each = (descended(trial, recipe.coordinates(values), none, _BRIEF, _SLACK * reach) for values in recipe.starts)
        ends += [(cost(end), recipe.number, [end.point.x]) for end in each if end is not None]
    ends.sort(key=lambda item: item[0])
    return [each for n, each in enumerate(ends[:_TIES]) if n < _STARTS or each[0] < ends[0][0] + _TIED]


def _weighed(study: Study, others: tuple, name: str, near_by: list, count: int) -> list:
    """The `count` of `near_by` that misfit least in all coordinates, from where they ended or the prior mean; and the first of all.

    In few coordinates the true place may be behind several others. Parameters adapt to first order.
    """
    if len(near_by) <= count:
        return near_by
    k, left = study.k, []
    for _, i, (end, *_) in near_by[: _weighed_beside(others)]:
        whole = study.with_cause(others, name, i)
        points = [whole.point(x) for x in (end, np.concatenate([np.zeros(k), end[k:]]))]
        cost = min((study.foreseen(at) for at in points if at is not None), default=np.inf)
        left.append(cost - 2 * whole.recipes[-1].log_prior)
    best = np.argsort(left, kind="stable")[:count].tolist()
    return [near_by[j] for j in (best if 0 in best else [*best, 0])]


def _ended(
    study: Study, first: Study, others: tuple, name: str, i: int, starts: list, most: int, reach: float
) -> Fit | None:
    """The fit of recipe i, in the coordinates of `first`, then in all from where the whole misfits least.

    That may be there, a start, or the same causes at the prior mean.
    """
    k, whole = study.k, study.with_cause(others, name, i)
    if first is not study:
        near = descended(first.with_cause(others, name, i), starts[0][k:], starts[0][:k], most, _SLACK * reach)
        starts = starts if near is None else [near.point.x, *starts]
        reach = reach if near is None or near.misfit > reach else np.inf
    plain = [np.concatenate([np.zeros(k), x[k:]]) for x in starts[:1]]
    points = [at for at in map(whole.point, [*starts, *plain]) if at is not None]
    if not points:
        return None
    x = min(points, key=lambda at: at.chi2 + at.x[:k] @ at.x[:k]).x
    one = fit(whole, x[k:], x[:k], most, reach)
    return one if one is None or (others and one.misfit > reach) else uncrossed(one, most, reach)


def summed(found: list[Fit], reach: float = np.inf) -> Fit | None:
    """The best of several optima, its theory taken for as good as it is; those at other places add to its evidence."""
    if not found:
        return None
    apart = distinct(found)
    total = np.logaddexp.reduce([one.log_evidence for one in apart])
    others = tuple((one, float(np.exp(one.log_evidence - total))) for one in apart[1:])
    best = idealised(apart[0]) if apart[0].misfit < reach else apart[0]
    log_evidence = best.log_evidence + float(total - apart[0].log_evidence) - unseen(best)
    return replace(best, log_evidence=log_evidence, elsewhere=others)
