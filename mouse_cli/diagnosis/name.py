"""Which physics: every candidate fitted beside the deck's own parameters, and their evidence compared.

A second cause is sought only where one alone leaves more than noise; it must gain enough to matter, and a cause whose absence
costs nothing is dropped again. Names are compared as groups: what the data cannot tell apart shares its probability.
"""

from collections.abc import Iterable
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from mouse_cli.diagnosis.candidates import registry
from mouse_cli.diagnosis.change import Recipe
from mouse_cli.diagnosis.fit import MOST, Fit, Model, Point, fit
from mouse_cli.diagnosis.reduced import Reduced
from mouse_cli.updating.chi_square import upper_tail

_STARTS, _SECOND = 3, 2  # fits of a candidate, from the best places of its grid: alone, and beside another
_QUICK, _SWAPPED, _FINISHED = (
    8,
    2,
    6,
)  # steps of a first try of two causes; pairs whose aliases are tried, and fitted to the end
_SETTLE, _MOVED = 3, 5e-3  # times that causes are weighed anew, as long as parameters move more than that share
_THEORY = 0.01  # of what a cause does to frequencies and shapes, by which its theory may be wrong
_SHIFTS = np.array([-5, -3, -2, -1, 1, 2, 3, 5]) / 50  # of the range of a place
_COARSE = 24  # coordinates at least for a first look
_PRIOR = 0.3, 0.6, 0.1  # probability that nothing is missing, one cause, two
_PAIRED = 8  # candidates that are tried in pairs
_ADEQUATE = 0.05  # probability of a misfit below which a second cause is sought
_MATERIAL = 3.0  # nats that a second cause must gain


@dataclass(frozen=True)
class Ranking:
    """fits: the baseline first, then the best of each set of causes, most probable first; noise_scale s2; probabilities of them."""

    baseline: Fit
    fits: tuple[Fit, ...]
    noise_scale: float
    probabilities: np.ndarray

    @property
    def groups(self) -> tuple[tuple[str, float], ...]:
        """Probability of each group, the largest first; `none` among them."""
        found: dict[str, float] = {}
        for one, p in zip(self.fits, self.probabilities, strict=True):
            found[group(one)] = found.get(group(one), 0.0) + float(p)
        return tuple(sorted(found.items(), key=lambda item: -item[1]))


class Study:
    """A reduced model, what each candidate can do to it, and the same at other parameters, where causes weigh otherwise."""

    def __init__(self, model: Reduced):
        self.model, self.k = model, model.L.shape[1]
        self._made: dict[str, list[Recipe]] = {}

    def recipes(self, name: str) -> list[Recipe]:
        """What candidate `name` can do, and where; made when first asked for."""
        if name not in self._made:
            candidate = registry()[name]
            made = candidate.recipes(self.model, candidate)
            self._made[name] = [replace(recipe, number=i) for i, recipe in enumerate(made)]
        return self._made[name]

    @cached_property
    def coarse(self) -> "Study":
        """The same in the lowest coordinates alone, in which all places and sizes are looked at before any is fitted."""
        least = max(_COARSE, 4 * self.model.data.m + 8, int(self.model.data.test.number.max()) + 12)
        return self if least >= self.model.r else Study(self.model.truncated(least))

    def starts(self, name: str, before: np.ndarray, beside: tuple[Recipe, ...]) -> list[tuple[int, np.ndarray]]:
        """Numbers of recipes of candidate `name`, and x to begin from, the most promising first."""
        others, found = self.own(beside), []
        for recipe in self.recipes(name):
            trial = Model(self.model, (*others, recipe))
            for values in recipe.grid:
                at = trial.point(np.concatenate([before, recipe.coordinates(values)]))
                if at is not None:
                    found.append((self.foreseen(at), recipe.number, at.x))
        found.sort(key=lambda item: item[0])
        return [(number, x) for _, number, x in found]

    @cached_property
    def _adapted(self) -> tuple[np.ndarray, np.ndarray]:
        """T (q, k), and (T'T + I)^-1 [T', -I] (k, q + k): how far the deck's parameters follow a residual."""
        plain = Model(self.model)
        T = plain.jacobian(plain.point(np.zeros(self.k)))
        return T, np.linalg.solve(T.T @ T + np.eye(self.k), np.hstack([T.T, -np.eye(self.k)]))

    def foreseen(self, at: Point) -> float:
        """The misfit that is left of `at` when the deck's parameters adapt, to first order."""
        T, adapted = self._adapted
        step = adapted @ np.concatenate([at.residual, at.x[: self.k]])
        left, z = at.residual - T @ step, at.x[: self.k] + step
        return float(left @ left + z @ z)

    def own(self, recipes: tuple[Recipe, ...]) -> tuple[Recipe, ...]:
        """The same causes at the same places in this model."""
        return tuple(self.recipes(recipe.candidate.key)[recipe.number] for recipe in recipes)

    def at(self, one: Fit) -> "Study":
        """The same at the parameters that a fit found."""
        theta = one.model.base.parameters(one.point.x[: self.k])
        return Study(self.model.at(theta))


def shifted(one: Fit) -> Fit:
    """The fit from places nearby: across the end of a finite element the misfit has a step, before which a descent stops."""
    model = one.model
    unknowns = [u for recipe in one.recipes for u in recipe.unknowns]
    for j in (i for i, u in enumerate(unknowns) if not u.log):
        T = np.delete(model.jacobian(one.point), model.k + j, axis=1)
        H = T.T @ T + np.diag((np.arange(T.shape[1]) < model.k).astype(float))
        best, start = one.misfit - 1, None
        for share in _SHIFTS:
            c = one.c.copy()
            c[j] = np.clip(c[j] + share * model.width[j], *model.bounds[j])
            at = model.point(np.concatenate([one.point.x[: model.k], c]))
            if at is None:
                continue
            pull = T.T @ at.residual - np.where(np.arange(T.shape[1]) < model.k, np.delete(at.x, model.k + j), 0.0)
            left = at.chi2 + at.x[: model.k] @ at.x[: model.k] - pull @ np.linalg.lstsq(H, pull, rcond=None)[0]
            if left < best:
                best, start = left, c
        again = None if start is None else fit(model, start, one.point.x[: model.k])
        if again is not None and again.misfit < one.misfit:
            one = again
    return one


def idealised(one: Fit | None) -> Fit | None:
    """The fit when the theory of its causes is right to some share of what they do."""
    if one is None or not one.recipes:
        return one
    base, at = one.model.base, one.point
    bare = Model(base).point(at.x[: one.model.k])
    if bare is None:
        return one
    off = _THEORY * 0.5 * np.log(at.eigenvalues[at.modes] / bare.eigenvalues[bare.modes])
    _, a = base.data.residual(bare.eigenvalues[bare.modes], bare.seen[:, bare.modes])
    moved = _THEORY * (at.a * at.seen[:, at.modes] - a * bare.seen[:, bare.modes])
    loose = Model(replace(base, data=base.data.loosened(off, moved)), one.recipes)
    return fit(loose, one.c, at.x[: one.model.k]) or one


def settled(one: Fit, study: Study) -> Fit:
    """The fit with its causes weighed at the parameters that it found, not at those where the search began."""
    for _ in range(_SETTLE):
        theta = one.model.base.parameters(one.point.x[: one.model.k])
        before = one.model.base.theta
        if not one.recipes or np.all(np.abs(theta - before) <= _MOVED * np.abs(before)):
            break
        there = study.at(one)
        base = replace(there.model, data=one.model.base.data)
        again = fit(Model(base, there.own(one.recipes)), one.c, one.point.x[: one.model.k])
        if again is None:
            break
        one = again
    return one


def group(one: Fit) -> str:
    """Groups of the causes of a fit; `none` without any. A support that gives way in two manners is one cause."""
    groups = sorted(recipe.candidate.group for recipe in one.recipes)
    return " + ".join(name for i, name in enumerate(groups) if name != "support" or name not in groups[:i]) or "none"


def key(one: Fit) -> tuple[str, ...]:
    """Keys of the causes of a fit, sorted."""
    return tuple(sorted(recipe.candidate.key for recipe in one.recipes))


def rank(model: Reduced) -> Ranking:
    """All that the candidates make of the data."""
    study = Study(model)
    baseline = settled(fit(Model(model), np.zeros(0)), study)
    singles = [one for name in registry() for one in [best(study, name)] if one is not None]
    fits = [baseline, *singles]
    if singles and not adequate(min(singles, key=lambda one: one.misfit)):
        fits += pairs(study, singles)
    return ranking(baseline, fits)


def ranking(baseline: Fit, fits: list[Fit]) -> Ranking:
    """Probabilities of `fits` with the noise scale that the best of them needs."""
    scale = max(
        1.0, min((one.misfit / one.dof for one in fits if one.dof > 0), default=1.0)
    )  # saturated fits say nothing
    weights = np.array([_prior(one, fits) + one.log_evidence / scale for one in fits])
    weights = np.exp(weights - weights.max())
    order = np.argsort(-weights)
    return Ranking(baseline, tuple(fits[i] for i in order), scale, weights[order] / weights.sum())


def _prior(one: Fit, fits: list[Fit]) -> float:
    """ln of the prior probability: shared evenly by groups, or by pairs of groups, and within a group by its members."""
    singles = {group(each) for each in fits if len(each.recipes) == 1}
    share = {0: 1, 1: max(len(singles), 1), 2: max(len(singles) * (len(singles) + 1) // 2, 1)}[len(one.recipes)]
    alike = sum(group(each) == group(one) and len(each.recipes) == len(one.recipes) for each in fits)
    return float(np.log(_PRIOR[len(one.recipes)] / share / alike))


def adequate(one: Fit, least: float = _ADEQUATE) -> bool:
    """Whether what a fit leaves may be noise."""
    return upper_tail(one.misfit, max(one.dof, 1)) > least


def best(study: Study, name: str) -> Fit | None:
    """The most probable fit of candidate `name` over all of its places, its evidence summed over distinct optima."""
    return _summed([settled(shifted(one), study) for one in tried(study, name, None, _STARTS)])


def tried(study: Study, name: str, beside: Fit | None, count: int, most: int = MOST) -> list[Fit]:
    """Fits of candidate `name` from its `count` most promising places, in at most so many steps; beside: causes there already."""
    others = () if beside is None else study.own(beside.recipes)
    before = np.zeros(study.k) if beside is None else beside.point.x
    found = []
    for number, x in study.coarse.starts(name, before, () if beside is None else beside.recipes)[:count]:
        trial = Model(study.model, (*others, study.recipes(name)[number]))
        found.append(fit(trial, x[trial.k :], x[: trial.k], most))
    return [one for one in found if one is not None]


def _summed(found: list[Fit]) -> Fit | None:
    """The best of several optima, its theory taken for as good as it is; those at other places add to its evidence."""
    if not found:
        return None
    found.sort(key=lambda one: -one.log_evidence)
    distinct: list[Fit] = []
    for one in found:
        if not any(_same(one, other) for other in distinct):
            distinct.append(one)
    others = np.logaddexp.reduce([one.log_evidence for one in distinct]) - distinct[0].log_evidence
    best = idealised(distinct[0])
    return replace(best, log_evidence=best.log_evidence + float(others))


def _same(one: Fit, other: Fit) -> bool:
    if [recipe.number for recipe in one.recipes] != [recipe.number for recipe in other.recipes]:
        return False
    sd = np.sqrt(np.abs(np.diag(one.covariance)[one.model.k :]))
    return bool((np.abs(one.c - other.c) < 2 * sd + 1e-3 * one.model.width).all())


def pairs(study: Study, singles: list[Fit]) -> list[Fit]:
    """Two causes: the leading one with every candidate, the leading ones with one another, and their aliases.

    All are tried in few steps; those that lead are fitted to the end.
    """
    leading = sorted(singles, key=lambda one: -one.log_evidence)[:_PAIRED]
    found: dict[tuple[str, ...], Fit] = {}
    for first in leading:
        partners = registry() if first is leading[0] else [one.recipes[0].candidate.key for one in leading]
        _pair(study, first, partners, found)
    done: set[tuple[str, ...]] = set()
    for _ in range(2):  # both causes may be there by an alias
        for two in _best_of(found, _SWAPPED):
            if key(two) not in done:
                done.add(key(two))
                _swap(study, two, singles, found)
    finished = [_summed([settled(shifted(two), study)]) for two in _best_of(found, _FINISHED)]
    return [two for two in finished if _material(two, singles)]


def _best_of(found: dict[tuple[str, ...], Fit], count: int) -> list[Fit]:
    return sorted(found.values(), key=lambda one: -one.log_evidence)[:count]


def _swap(study: Study, two: Fit, singles: list[Fit], found: dict[tuple[str, ...], Fit]) -> None:
    """Into `found` the same two causes with either replaced by what is hard to tell from it."""
    for recipe in two.recipes:
        own = recipe.candidate
        aliases = [name for name, each in registry().items() if each.group == own.group and name != own.key]
        rest = {*key(two)} - {own.key}
        for first in (one for one in singles if {*key(one)} == rest):
            _pair(study, first, aliases, found)


def _pair(study: Study, first: Fit, partners: Iterable[str], found: dict[tuple[str, ...], Fit]) -> None:
    """Into `found` what `first` and each partner make together, where it is better than what is there."""
    there = study.at(first)
    for name in partners:
        for two in tried(there, name, first, _SECOND, _QUICK):
            other = found.get(key(two))
            if other is None or two.log_evidence > other.log_evidence:
                found[key(two)] = two


def _material(two: Fit, singles: list[Fit]) -> bool:
    """Whether both causes are needed: what two gain over the better of them alone."""
    alone = [one.log_evidence for one in singles if set(key(one)) <= set(key(two))]
    return not alone or two.log_evidence - max(alone) > _MATERIAL
