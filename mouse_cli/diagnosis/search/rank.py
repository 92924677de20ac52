"""Which physics: every hypothesis fitted beside the deck's own parameters, and their evidence compared.

Several mechanisms are sought only where one alone leaves more than noise, and each must gain enough to matter. What has no name
competes with what has. Names are compared as groups: what the data cannot tell apart shares its probability.
"""

from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from math import lgamma

import numpy as np

from mouse_cli.diagnosis import gates
from mouse_cli.diagnosis.likelihoods.modal.accuracy import Doubt, doubts, ways
from mouse_cli.diagnosis.likelihoods.modal.model import Model
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.likelihoods.modal.scales import span
from mouse_cli.diagnosis.mechanisms import Candidate
from mouse_cli.diagnosis.nameless.fit import rivals
from mouse_cli.diagnosis.nameless.joint import joint_rivals
from mouse_cli.diagnosis.noise import LOUD, scale
from mouse_cli.diagnosis.search.alone import alone
from mouse_cli.diagnosis.search.descents import settled
from mouse_cli.diagnosis.search.disguised import disguised
from mouse_cli.diagnosis.search.fit import Fit, fit
from mouse_cli.diagnosis.search.found import Found
from mouse_cli.diagnosis.search.grounded import one_tie
from mouse_cli.diagnosis.search.levelled import levelled
from mouse_cli.diagnosis.search.moves import adequate
from mouse_cli.diagnosis.search.optima import within
from mouse_cli.diagnosis.search.pared import plainest
from mouse_cli.diagnosis.search.pool import Pool
from mouse_cli.diagnosis.search.several import FURTHER, enough, plain, several
from mouse_cli.diagnosis.search.study import Study
from mouse_cli.model.diagnosis import LAW, Untried
from mouse_cli.model.groups import joined, shares
from mouse_cli.model.shared_place import panels, together
from mouse_cli.model.site import as_read, gap
from mouse_cli.updating.chi_square import upper_tail

NOISY = 1.5  # noise scale above which the accuracies of the test themselves are in doubt
_UNPHYSICAL = "no size of it makes a model whose modes can be paired with the test"
_TRUSTED = 0.5  # share of the stated accuracies in the leading explanation below which errors of the test may be all
_ENTRY = 0.99  # probability of one wrong entry of the test from which on nothing further is sought behind it
# Probability of no mechanism above which what has no name is not asked where that leaves no more than chance
_IDLE = 0.5
_SIZES = ("support", "taper")  # groups that have more than one size and yet no place that these could move
_BY_SIZE = ("mass", "oscillator")  # groups whose stiffness at their place follows the frequency by few sizes
_PLAIN = 2  # mechanisms up to which a set that explains the data needs no two rivals without a name beside it


@dataclass(frozen=True)
class Ranking:
    """fits: no mechanism, and the best of each hypothesis, most probable first; probabilities (f,) of them.

    log_odds (f,): ln of how much better each predicts the data than the model as it is, noise and errors of the test integrated
    out; noise_scale: s^2 of the leading one. doubts: how probable errors of the test are, whatever the mechanism; stated (f,):
    that of none, for each fit. untried: candidates that could not be tried, and why. by_fitted (f,): probabilities without what the
    deck holds out, where that is in them.
    """

    baseline: Fit
    fits: tuple[Fit, ...]
    noise_scale: float
    probabilities: np.ndarray
    doubts: tuple[Doubt, ...]
    stated: np.ndarray
    log_odds: np.ndarray
    untried: tuple[Untried, ...] = ()
    by_fitted: np.ndarray | None = None

    @property
    def groups(self) -> tuple[tuple[str, float], ...]:
        """Probability of each group, the largest first; `none` among them, and what has no name by its own key.

        A field counts as the mechanism that it is where it does not vary, if that is the more probable of the two: soil on which
        a building moves as one rigid body as a flexible support, a spring in the panels of a brace as a brace, a section that
        changes linearly along one member as a taper. A law counts as the spring, mass or oscillator at its site unless it is
        ODDS more probable.
        """
        return shares(*zip(*_counted(self.fits, self.probabilities), strict=True))

    @property
    def scattered(self) -> bool:
        """Whether more scatter than is stated explains the data as well as any mechanism: none has ODDS over it, and none explains
        them by what is stated.
        """
        lead = float(self.log_odds.max()) <= gates.ODDS and self.noise_scale <= LOUD
        return lead and not any(one.recipes and explains(one) for one in self.fits)

    @property
    def named(self) -> list[int]:
        """Indices of the fits that have a name, or are of no mechanism."""
        return [i for i, one in enumerate(self.fits) if unnamed(one) is None]


def group(one: Fit) -> str:
    """Groups of the mechanisms of a fit, as it found them; the key of a rival that has no name."""
    return unnamed(one) or joined(one.groups)


def _joined(one: Fit) -> str:
    """Groups of its candidates, which share the prior."""
    return joined([recipe.candidate.group for recipe in one.recipes])


def _counted(fits: tuple[Fit, ...], probabilities: np.ndarray) -> Iterator[tuple[str, float]]:
    """Groups of fits, the most probable first, and what each adds to their probability; a field adds to several, and what is one
    tie to the ground with a more probable fit to that.
    """
    even: dict[str, Fit] = {}  # of what acts alike everywhere, or moves the whole, the first of each group
    local: dict[str, tuple[Fit, float]] = {}  # the first single mechanism of each group, and its probability
    for one, p in zip(fits, probabilities.tolist(), strict=True):
        if len(one.recipes) == 1:
            local.setdefault(group(one), (one, p))
    ties: set[str] = set()  # groups that others have been counted to
    for i, (one, p) in enumerate(zip(fits, probabilities.tolist(), strict=True)):
        name, variants = group(one), one.variants if one.nameless else ()
        tie = next((each for each in fits[:i] if one_tie(each, one)), None)
        if tie is not None and name not in ties:
            there = 1 - sum(share for other, share in one.elsewhere if not one_tie(tie, other))
            yield group(tie), p * there
            ties.add(group(tie))
            p *= 1 - there
        for part, share in ((one, 1 - sum(share for _, share in variants)), *variants):
            limit = part.nameless.rival.even if part.nameless else ""
            if name == LAW:
                limit = next((own for own in local if own in (limit, *_BY_SIZE) and _suffices(*local[own], part, p)), "")
                contained = bool(limit)
            else:
                contained = limit in even and _contains(even[limit], part)
            yield (limit if contained else name), p * share
        if len(one.recipes) == 1 and (len(one.recipes[0].unknowns) == 1 or name in _SIZES):
            even.setdefault(name, one)


def _suffices(known: Fit, p: float, law: Fit, of_law: float) -> bool:
    """Whether a law is the spring, hinge or brace at its site, or what follows the frequency by one or two sizes: that explains the
    data, and that the stiffness varies from mode to mode in another way is not shown (ODDS).
    """
    base, sites = known.model.base, (known.sites[0], law.nameless.cells.sites[0])
    near = gap(*sites) <= gates.SAME_SITE * span(base)
    near = near or (group(known) == "brace" and panels(base.problem.mesh, sites))
    return near and adequate(known, gates.GATE) and p >= np.exp(-gates.ODDS) * of_law


def _contains(known: Fit, field: Fit) -> bool:
    """Whether a field acts where a mechanism does: one between two places in the line of panels that a spring crosses, a gradient
    along the member of a taper.

    What else is even acts everywhere.
    """
    rival = field.nameless.rival
    if rival.gradient:
        return {i for site in field.nameless.cells.sites for i in site.ids} <= set(known.sites[0].ids)
    if rival.key != "spring":
        return True
    mesh = known.model.base.problem.mesh
    return mesh is not None and panels(mesh, [known.sites[0], together(mesh, field.nameless.cells.sites)])


def unnamed(one: Fit) -> str | None:
    """Key of the rival without a name that a fit is, openly or in disguise; None: it has a name, or is of no mechanism."""
    return one.nameless.rival.key if one.nameless else disguised(one)


def rank(
    model: Reduced,
    known: dict[str, Candidate] | None = None,
    causes: int = 2,
    by_all: Callable[[Ranking], Ranking] = lambda found: found,
    kind: type[Model] = Model,
    last: bool = True,
    jobs: int = 1,
    again: Callable[[], Reduced] | None = None,
) -> Ranking:
    """All that the candidates (`known`; None: all) make of the data, at most `causes` of them together.

    by_all: what further data make of a ranking, before several are sought and after. kind: see `Study`. last: False where further
    mechanisms will be sought besides, so that what has no name is no rival yet. jobs, again: processes, see `Pool`.
    """
    study = Study(model, known, kind)
    with Pool(study, jobs, again) as study.pool:
        return _ranked(study, causes, by_all, last)


def _ranked(study: Study, causes: int, by_all: Callable[[Ranking], Ranking], last: bool) -> Ranking:
    """The same, of a study."""
    model, kind = study.model, study.kind
    baseline = settled(fit(kind(model), np.zeros(0)), study)
    singles, begun = alone(study, baseline, causes)
    fits = [baseline, *singles]
    found = by_all(ranking(baseline, fits))
    none = dict(found.groups).get("none", 0.0)
    entry = sum(doubt.probability for doubt in found.doubts if doubt.modes)
    if none > _IDLE and entry > _ENTRY and found.noise_scale <= NOISY:
        return replace(found, untried=_untried(study, singles))
    if found.baseline.errs_alike and found.baseline.data is not baseline.data:
        study, baseline, begun = study.judged_by(found.baseline.data), found.baseline, Found()
        model, fits, singles = study.model, list(found.fits), [one for one in found.fits if one.recipes]
    if last and (none < _IDLE or not adequate(found.baseline, gates.GATE)):
        fits += rivals(model, baseline, kind, within([*fits, *begun.values()]))
    one_each = plain(one for one in found.fits if one.recipes)
    others = model.problem.frf or model.problem.recordings  # which may feel what modes do not
    further = causes > 1 and singles and len(found.fits) > 1 and (others or not found.scattered)
    if further and not any(enough(one, FURTHER, gates.GATE) for one in one_each):
        trusted = found.stated[0] > _TRUSTED or found.noise_scale > LOUD
        fits += several(study, singles, causes, trusted, begun)
    if kind is Model and not others and any(one.nameless for one in fits) and not any(map(_simple, fits)):
        fits += joint_rivals(model, fits)
    kept = _once(fits if others else plainest(fits))
    if len(fits) > 1 + len(singles) or len(kept) < len(fits):
        found = by_all(ranking(baseline, kept))
    return replace(found, untried=_untried(study, singles))


def _once(fits: list[Fit]) -> list[Fit]:
    """Of fits of the same mechanisms at the same sites, found as sets of more parts that were not needed, the most probable."""
    best: dict[tuple, Fit] = {}
    for one in fits:
        pairs = zip(one.recipes, one.sites, strict=True)
        key = tuple(sorted((recipe.candidate.key, as_read((site,))) for recipe, site in pairs))
        other = best.get(key)
        if one.nameless or not key or other is None or one.log_evidence > other.log_evidence:
            best[key if key and not one.nameless else (id(one),)] = one
    return [one for one in fits if any(one is each for each in best.values())]


def explains(one: Fit) -> bool:
    """Whether what an explanation leaves may be noise, or is next to it; several mechanisms are held to more."""
    dof = max(one.dof, 1)
    p = upper_tail(one.misfit, dof)
    return p >= gates.SEVERAL if len(one.recipes) > 1 else p >= gates.GATE or one.misfit <= one.bearable * dof


def _simple(one: Fit) -> bool:
    """Whether a fit of at most two mechanisms, or of one rival without a name, explains the data."""
    return len(one.recipes) <= _PLAIN and explains(one)


def _untried(study: Study, singles: list[Fit]) -> tuple[Untried, ...]:
    """Candidates without a site in the model, or without a fit at any of them."""
    tried = {one.recipes[0].candidate.key for one in singles}
    reason = lambda name: _UNPHYSICAL if study.recipes(name) else study.known[name].why(study.model.first)
    return tuple(Untried(name, reason(name)) for name in study.known if name not in tried)


def ranking(baseline: Fit, fits: list[Fit]) -> Ranking:
    """Probabilities of `fits`; errors of the test, and noise larger than stated, are integrated out for each of them.

    One whose evidence is no finite number says nothing, and is left out.
    """
    fits = [one for one in fits if one is baseline or np.isfinite(one.log_evidence)]
    each = [ways(one) for one in fits]
    left = [one.dof + one.idle(scale(one.misfit, one.dof)) for one in fits]  # what is idle is fitted by no noise
    parts = [np.array([way.log_weight(dof) for way in own]) for dof, own in zip(left, each, strict=True)]
    totals = np.array([np.logaddexp.reduce(part) for part in parts])
    evidence = totals + np.array([one.log_evidence for one in fits])
    weights = evidence + np.array([_log_prior(one, fits) for one in fits])
    weights = np.exp(weights - weights.max())
    weights = levelled(weights / weights.sum(), fits)
    order = np.argsort(-weights, kind="stable")
    shared = [np.exp(part - total) for part, total in zip(parts, totals, strict=True)]
    stated = np.array([share[0] for share in shared])[order]
    found = doubts([(p, own, share) for p, own, share in zip(weights, each, shared, strict=True)])
    first = order[0]
    way = each[first][int(np.argmax(parts[first]))]
    odds = evidence - evidence[next(i for i, one in enumerate(fits) if one is baseline)]
    noise = scale(float(way.misfit.min()), fits[first].dof)
    return Ranking(baseline, tuple(fits[i] for i in order), noise, weights[order], found, stated, odds[order])


def _log_prior(one: Fit, fits: list[Fit]) -> float:
    """ln of the prior probability: shared evenly by sets of groups, and within one by its members.

    Sites of several of one kind are a set, which the product of their own priors counts in every order.
    """
    if one.nameless:
        parts = one.nameless.rival.parts
        alike = sum(each.nameless is not None and each.nameless.rival.parts == parts for each in fits)
        return float(np.log(gates.NAMELESS * gates.MORE ** (parts - 1) / alike))
    alike = sum(
        not each.nameless and len(each.recipes) == len(one.recipes) and _joined(each) == _joined(one) for each in fits
    )
    groups = {_joined(each) for each in fits if len(each.recipes) == 1}
    orders = sum(lgamma(count + 1) for count in Counter(recipe.candidate.key for recipe in one.recipes).values())
    of_one = len({recipe.candidate.group for recipe in one.recipes}) == 1
    return gates.log_prior(len(one.recipes), len(groups), of_one) - float(np.log(alike)) + orders
