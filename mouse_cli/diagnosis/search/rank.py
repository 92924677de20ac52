"""Which physics: every candidate fitted beside the deck's own parameters, and their evidence compared.

A second cause is sought only where one alone leaves more than noise, and must gain enough to matter. Names are compared as groups:
what the data cannot tell apart shares its probability.
"""

from collections.abc import Callable, Iterable
from dataclasses import dataclass

import numpy as np

from mouse_cli.diagnosis.likelihoods.modal.accuracy import Doubt, doubts, ways
from mouse_cli.diagnosis.likelihoods.modal.model import Model
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.mechanisms import Candidate
from mouse_cli.diagnosis.search.fit import Fit, fit
from mouse_cli.diagnosis.search.study import Study, best, settled, shifted, summed, tried
from mouse_cli.model.groups import joined, shares
from mouse_cli.updating.chi_square import upper_tail

_SECOND, _QUICK = 2, 8  # fits of a second cause beside a first, and their steps, in a first try
_SWAPPED, _FINISHED = 2, 6  # pairs whose aliases are tried; pairs that are fitted to the end
_PRIOR = 0.3, 0.6, 0.1  # probability that nothing is missing, one cause, two
_PAIRED, _WIDE = 8, 5  # candidates that are tried in pairs; groups of which the best is tried with every candidate
_ADEQUATE = 0.05  # probability of a misfit below which a second cause is sought
_FAR = 200.0  # misfit above the best one, by the noise scale, from which on a fit is no rival
_MATERIAL = 3.0  # nats that a second cause must gain


@dataclass(frozen=True)
class Ranking:
    """fits: no cause, and the best of each set of causes, most probable first; noise_scale s2; probabilities (f,) of them.

    doubts: how probable errors of the test are, whatever the cause. stated (f,): that of none, for each fit.
    """

    baseline: Fit
    fits: tuple[Fit, ...]
    noise_scale: float
    probabilities: np.ndarray
    doubts: tuple[Doubt, ...]
    stated: np.ndarray

    @property
    def groups(self) -> tuple[tuple[str, float], ...]:
        """Probability of each group, the largest first; `none` among them."""
        return shares([group(one) for one in self.fits], self.probabilities)


def group(one: Fit) -> str:
    """Groups of the causes of a fit."""
    return joined([recipe.candidate.group for recipe in one.recipes])


def key(one: Fit) -> tuple[str, ...]:
    """Keys of the causes of a fit, sorted."""
    return tuple(sorted(recipe.candidate.key for recipe in one.recipes))


def rank(
    model: Reduced,
    known: dict[str, Candidate] | None = None,
    causes: int = 2,
    hear: Callable[[Ranking], Ranking] = lambda found: found,
    kind: type[Model] = Model,
) -> Ranking:
    """All that the candidates (`known`; None: all) make of the data, at most `causes` (1, 2) of them together.

    hear: what further data make of a ranking, before a second cause is sought and after. kind: see `Study`.
    """
    study = Study(model, known, kind)
    baseline = settled(fit(kind(model), np.zeros(0)), study)
    singles: list[Fit] = []
    for name in study.promising():
        one = best(study, name, _reach([baseline, *singles]))
        singles += [] if one is None else [one]
    fits = [baseline, *singles]
    found = hear(ranking(baseline, fits))
    with_cause = [one for one in found.fits if one.recipes]
    if causes > 1 and with_cause and not adequate(min(with_cause, key=lambda one: one.misfit)):
        found = hear(ranking(baseline, fits + pairs(study, singles)))
    return found


def _reach(found: list[Fit]) -> float:
    """Misfit above which a fit can be no rival of the best of `found`."""
    least = min(found, key=lambda one: one.misfit)
    return least.misfit + _FAR * max(1.0, least.misfit / max(least.dof, 1))


def ranking(baseline: Fit, fits: list[Fit]) -> Ranking:
    """Probabilities of `fits`, errors of the test weighed beside each, with the noise scale that the best of them needs."""
    beside = [ways(one) for one in fits]
    telling = [
        way.misfit.min() / one.dof for one, own in zip(fits, beside, strict=True) for way in own if one.dof > 0
    ]  # saturated fits say nothing
    scale = max(1.0, min(telling, default=1.0))
    parts = [np.array([way.log_weight(scale) for way in own]) for own in beside]
    totals = np.array([np.logaddexp.reduce(part) for part in parts])
    weights = totals + np.array([_prior(one, fits) + one.log_evidence / scale for one in fits])
    order = np.argsort(-weights, kind="stable")
    weights = np.exp(weights - weights.max())
    weights /= weights.sum()
    shares = [np.exp(part - total) for part, total in zip(parts, totals, strict=True)]
    stated = np.array([share[0] for share in shares])[order]
    found = doubts([(p, own, share) for p, own, share in zip(weights, beside, shares, strict=True)])
    return Ranking(baseline, tuple(fits[i] for i in order), scale, weights[order], found, stated)


def _prior(one: Fit, fits: list[Fit]) -> float:
    """ln of the prior probability: shared evenly by groups, or by pairs of groups, and within a group by its members."""
    singles = {group(each) for each in fits if len(each.recipes) == 1}
    share = {0: 1, 1: max(len(singles), 1), 2: max(len(singles) * (len(singles) + 1) // 2, 1)}[len(one.recipes)]
    alike = sum(group(each) == group(one) and len(each.recipes) == len(one.recipes) for each in fits)
    return float(np.log(_PRIOR[len(one.recipes)] / share / alike))


def adequate(one: Fit, least: float = _ADEQUATE) -> bool:
    """Whether what a fit leaves may be noise."""
    return upper_tail(one.misfit, max(one.dof, 1)) > least


def pairs(study: Study, singles: list[Fit]) -> list[Fit]:
    """Two causes: the leading ones of different groups with every candidate, the leading ones with one another, and aliases.

    All are tried in few steps; those that lead are fitted to the end.
    """
    leading = sorted(singles, key=lambda one: -one.log_evidence)[:_PAIRED]
    firsts = {group(one): one for one in reversed(leading)}  # the best of each group
    wide = sorted(firsts.values(), key=lambda one: -one.log_evidence)[:_WIDE]
    found: dict[tuple[str, ...], Fit] = {}
    for first in leading:
        any_of = any(first is one for one in wide)
        _pair(study, first, study.known if any_of else [one.recipes[0].candidate.key for one in leading], found)
    done: set[tuple[str, ...]] = set()
    for _ in range(2):  # both causes may be there by an alias
        for two in _best_of(found, _SWAPPED):
            if key(two) not in done:
                done.add(key(two))
                _swap(study, two, singles, found)
    finished = [summed([settled(shifted(two), study)]) for two in _best_of(found, _FINISHED)]
    return [two for two in finished if _material(two, singles)]


def _best_of(found: dict[tuple[str, ...], Fit], count: int) -> list[Fit]:
    return sorted(found.values(), key=lambda one: -one.log_evidence)[:count]


def _swap(study: Study, two: Fit, singles: list[Fit], found: dict[tuple[str, ...], Fit]) -> None:
    """Into `found` the same two causes with either replaced by what is hard to tell from it."""
    for recipe in two.recipes:
        own = recipe.candidate
        aliases = [name for name, each in study.known.items() if each.group == own.group and name != own.key]
        rest = {*key(two)} - {own.key}
        for first in (one for one in singles if {*key(one)} == rest):
            _pair(study, first, aliases, found)


def _pair(study: Study, first: Fit, partners: Iterable[str], found: dict[tuple[str, ...], Fit]) -> None:
    """Into `found` what `first` and each partner make together, where it is better than what is there."""
    there = study.at(first)
    for name in partners:
        for two in tried(there, name, first, _SECOND, _QUICK, _reach([first, *found.values()])):
            other = found.get(key(two))
            if other is None or two.log_evidence > other.log_evidence:
                found[key(two)] = two


def _material(two: Fit, singles: list[Fit]) -> bool:
    """Whether both causes are needed: what two gain over the better of them alone."""
    alone = [one.log_evidence for one in singles if set(key(one)) <= set(key(two))]
    return not alone or two.log_evidence - max(alone) > _MATERIAL
