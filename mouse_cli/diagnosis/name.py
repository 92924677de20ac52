"""Which physics: every candidate fitted beside the deck's own parameters, and their evidence compared.

A second cause is sought only where one alone leaves more than noise; it must gain enough to matter, and a cause whose absence
costs nothing is dropped again. Names are compared as groups: what the data cannot tell apart shares its probability.
"""

from collections.abc import Iterable
from dataclasses import dataclass, replace

import numpy as np

from mouse_cli.diagnosis.candidates import registry
from mouse_cli.diagnosis.change import Recipe
from mouse_cli.diagnosis.fit import Fit, Model, fit
from mouse_cli.diagnosis.reduced import Reduced
from mouse_cli.updating.chi_square import upper_tail

_STARTS = 3  # fits of a candidate, from the best places of its grid
_NONE = 0.3  # prior probability that nothing is missing
_PAIRED = 5  # candidates that are tried in pairs
_ADEQUATE = 0.05  # probability of a misfit below which a second cause is sought
_MATERIAL, _SHARE = 3.0, 0.01  # nats that a second cause must gain, and share of the gain so far
_NEEDED = 3.0  # nats that leaving a cause out must cost


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


def group(one: Fit) -> str:
    """Groups of the causes of a fit; `none` without any."""
    return " + ".join(sorted(recipe.candidate.group for recipe in one.recipes)) or "none"


def key(one: Fit) -> tuple[str, ...]:
    """Keys of the causes of a fit, sorted."""
    return tuple(sorted(recipe.candidate.key for recipe in one.recipes))


def rank(model: Reduced) -> Ranking:
    """All that the candidates make of the data."""
    baseline = fit(Model(model), np.zeros(0))
    recipes = {name: candidate.recipes(model, candidate) for name, candidate in registry().items()}
    singles = [found for own in recipes.values() for found in [best(model, own)] if found is not None]
    fits = [baseline, *singles]
    if singles and not adequate(min(singles, key=lambda one: one.misfit)):
        fits += pairs(model, recipes, baseline, singles)
    return ranking(baseline, fits)


def ranking(baseline: Fit, fits: list[Fit]) -> Ranking:
    """Probabilities of `fits` with the noise scale that the best of them needs."""
    scale = max(1.0, min(one.misfit / max(one.dof, 1) for one in fits))
    kinds: dict[str, int] = {}
    for one in fits:
        kinds[group(one)] = kinds.get(group(one), 0) + 1
    others = max(len(kinds) - 1, 1)
    weights = [
        np.log(_NONE if group(one) == "none" else (1 - _NONE) / others / kinds[group(one)]) + one.log_evidence / scale
        for one in fits
    ]
    weights = np.exp(np.array(weights) - max(weights))
    order = np.argsort(-weights)
    return Ranking(baseline, tuple(fits[i] for i in order), scale, weights[order] / weights.sum())


def adequate(one: Fit, least: float = _ADEQUATE) -> bool:
    """Whether what a fit leaves may be noise."""
    return upper_tail(one.misfit, max(one.dof, 1)) > least


def best(model: Reduced, recipes: Iterable[Recipe], beside: Fit | None = None) -> Fit | None:
    """The candidate's most probable fit over all of its places, its evidence summed over distinct optima.

    beside: causes that are there already.
    """
    starts = []
    for recipe in recipes:
        trial = Model(model, (*(beside.recipes if beside else ()), recipe))
        before = np.concatenate([beside.point.x if beside else model.z])
        for values in recipe.grid:
            at = trial.point(np.concatenate([before, recipe.coordinates(values)]))
            if at is not None:
                starts.append((at.chi2, trial, at.x))
    starts.sort(key=lambda item: item[0])
    found: list[Fit] = []
    for _, trial, x in starts[: _STARTS if beside is None else 2]:
        one = fit(trial, x[trial.k :], x[: trial.k])
        if one is not None:
            found.append(one)
    return _summed(found)


def _summed(found: list[Fit]) -> Fit | None:
    """The best of several optima; those at other places add to its evidence."""
    if not found:
        return None
    found.sort(key=lambda one: -one.log_evidence)
    distinct: list[Fit] = []
    for one in found:
        if not any(_same(one, other) for other in distinct):
            distinct.append(one)
    total = np.logaddexp.reduce([one.log_evidence for one in distinct])
    return replace(distinct[0], log_evidence=float(total))


def _same(one: Fit, other: Fit) -> bool:
    if one.recipes != other.recipes:
        return False
    sd = np.sqrt(np.abs(np.diag(one.covariance)[one.model.k :]))
    return bool((np.abs(one.c - other.c) < 2 * sd + 1e-3 * one.model.width).all())


def pairs(model: Reduced, recipes: dict[str, list[Recipe]], baseline: Fit, singles: list[Fit]) -> list[Fit]:
    """Two causes: the leading one with every candidate, and the best of the leading groups with one another."""
    leading = _leading(singles)
    found: dict[tuple[str, ...], Fit] = {}
    for first in leading:
        partners = recipes if first is leading[0] else [one.recipes[0].candidate.key for one in leading]
        for name in partners:
            two = best(model, recipes[name], first)
            if two is not None and _material(two, first, baseline):
                other = found.get(key(two))
                if other is None or two.log_evidence > other.log_evidence:
                    found[key(two)] = two
    return [two for two in found.values() if _both_needed(two, singles)]


def _leading(singles: list[Fit]) -> list[Fit]:
    """The best fit of each group, most evident first, as many as are paired."""
    found: dict[str, Fit] = {}
    for one in sorted(singles, key=lambda one: -one.log_evidence):
        found.setdefault(group(one), one)
    return list(found.values())[:_PAIRED]


def _material(two: Fit, first: Fit, baseline: Fit) -> bool:
    """Whether the second cause gains enough beside what the first has gained."""
    so_far = first.log_evidence - baseline.log_evidence
    return two.log_evidence - first.log_evidence > max(_MATERIAL, _SHARE * so_far)


def _both_needed(two: Fit, singles: list[Fit]) -> bool:
    """Whether leaving either cause out costs something."""
    alone = [one.log_evidence for one in singles if set(key(one)) <= set(key(two))]
    return not alone or two.log_evidence - max(alone) > _NEEDED
