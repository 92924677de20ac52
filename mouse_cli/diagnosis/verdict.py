"""What may be said: nothing is missing, it is this, it is one of these, or something no candidate explains."""

from dataclasses import dataclass, replace

import numpy as np

from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.search.fit import GATE, Fit
from mouse_cli.diagnosis.search.rank import Ranking, group
from mouse_cli.diagnosis.validate.held_out import held_out
from mouse_cli.model.diagnosis import (
    BY_DECK,
    NAMED,
    NOTHING,
    ONE_OF,
    RIVAL,
    UNKNOWN,
    Cause,
    Explanation,
    HeldOut,
    Site,
    Size,
)
from mouse_cli.model.groups import leading
from mouse_cli.model.units import Units
from mouse_cli.updating.chi_square import upper_tail

SURE = 0.9  # probability of a group from which on it is named
ODDS = 3.0  # nats over no cause at all that a name needs
_BELIEVED = 0.5  # share of the stated accuracies in the leading explanation below which the test itself is the finding
_STANDS = 1e-6  # probability of no cause below which some cause acts, whatever errors the test has


def doubtful(baseline: Fit, rejected: bool) -> bool:
    """Whether what the update leaves is no chance: misfit, shift of the parameters, or both together (`rejected`)."""
    return rejected or baseline.strained or upper_tail(baseline.misfit, baseline.dof) < GATE


@dataclass(frozen=True)
class Verdict:
    """kind of answer; best: the fit that leads, with a cause; proof: how it predicts what was held out; refuted: groups by that."""

    kind: str
    best: Fit | None
    proof: HeldOut | None
    refuted: tuple[str, ...] = ()


def judge(ranking: Ranking, rejected: bool, model: Reduced) -> Verdict:
    """What may be said of all fits: by their evidence, and by data that none of them has seen; rejected: by the update itself.

    Something is missing where the update leaves too much, or where it is sure that some cause acts and what the deck holds out
    confirms the first of them: two judgements on different data. Of thousands of data that say so, none need be held out.
    A cause that is refuted gives its place to the next rival.
    """
    baseline, best = ranking.baseline, leader(ranking)
    demanded = doubtful(baseline, rejected) or (baseline.telling and dict(ranking.groups).get("none", 0.0) < GATE)
    certain = best is not None and sure(ranking)
    proof = held_out(model, baseline, best if demanded or certain else None)
    if not demanded and not (certain and _gain(proof) > ODDS):
        return Verdict(NOTHING, None, None if proof is None else replace(proof, revised=None))
    kind = decide(ranking)
    if kind == UNKNOWN or best is None or not _gain(proof) < -ODDS:
        return Verdict(kind, best, proof)
    struck = [group(best)]
    for name in (name for name, p in ranking.groups if p > RIVAL and name not in ("none", *struck)):
        other = next(one for one in ranking.fits if group(one) == name)
        again = held_out(model, baseline, other)
        if not _gain(again) < -ODDS:
            return Verdict(ONE_OF, other, again, tuple(struck))
        struck.append(name)
    return Verdict(UNKNOWN, best, proof, tuple(struck))


def leader(ranking: Ranking) -> Fit | None:
    """The leading fit of the leading group that has a cause; None without any."""
    at = leading(ranking.groups, [group(one) for one in ranking.fits])
    return ranking.fits[at] if at is not None and ranking.fits[at].recipes else None


def sure(ranking: Ranking) -> bool:
    """Whether some cause acts, whichever it is, and the test may be as accurate as it is said to be."""
    return dict(ranking.groups).get("none", 0.0) <= 1 - SURE and ranking.stated[0] >= _BELIEVED


def decide(ranking: Ranking) -> str:
    """The kind of answer when something is missing, by the gates of adequacy, probability and odds."""
    first, (name, probability) = ranking.fits[0], ranking.groups[0]
    dof = max(first.dof, 1)
    if upper_tail(first.misfit, dof) < GATE and first.misfit > first.bearable * dof:
        return UNKNOWN
    if first.strained:
        return UNKNOWN
    if ranking.stated[0] < _BELIEVED and dict(ranking.groups).get("none", 0.0) > _STANDS:
        return UNKNOWN  # the test is not as accurate as it is said to be, and what is missing besides cannot be told
    if not first.model.base.data.by_shape and any(recipe.own for recipe in first.recipes):
        return ONE_OF  # paired by number, a list of frequencies cannot prove that it holds one mode more
    if probability < SURE:
        return ONE_OF
    if name == "none":
        return UNKNOWN
    odds = (first.log_evidence - ranking.baseline.log_evidence) / ranking.noise_scale
    return NAMED if odds > ODDS else ONE_OF


def _gain(proof: HeldOut | None) -> float:
    """Nats by which a cause predicts data that the deck holds out better than the model without it; 0 without such data."""
    if proof is None or proof.revised is None or proof.kind != BY_DECK:
        return 0.0
    return proof.revised.log_predictive_density - proof.baseline.log_predictive_density


def explanations(ranking: Ranking) -> tuple[Explanation, ...]:
    """All fits in words and numbers."""
    return tuple(explanation(one, float(p)) for one, p in zip(ranking.fits, ranking.probabilities, strict=True))


def explanation(one: Fit, probability: float = 0.0) -> Explanation:
    """A fit as the report gives it."""
    sd, units = np.sqrt(np.abs(np.diag(one.covariance)))[one.model.k :], one.model.base.problem.units
    causes = tuple(
        _cause(recipe, one.c[own], sd[own], units) for recipe, own in zip(one.recipes, one.model.own, strict=True)
    )
    theta = one.model.base.parameters(one.point.x[: one.model.k])
    p = upper_tail(one.misfit, max(one.dof, 1))
    elsewhere = tuple((_sites(other), share) for other, share in one.elsewhere if share > RIVAL)
    return Explanation(causes, one.misfit, one.dof, p, one.log_evidence, theta, probability, elsewhere)


def _sites(one: Fit) -> tuple[Site, ...]:
    return tuple(r.site(r.values(one.c[own])) for r, own in zip(one.recipes, one.model.own, strict=True))


def _cause(recipe, c: np.ndarray, sd: np.ndarray, units: Units) -> Cause:
    values = recipe.values(c)
    sizes = tuple(
        Size(u.name, units.of(u.unit), float(v), float(s * v if u.log else s), u.lower, u.upper)
        for u, v, s in zip(recipe.unknowns, values, sd, strict=True)
    )
    candidate = recipe.candidate
    return Cause(candidate.key, candidate.group, candidate.title, recipe.site(values), sizes, recipe.law)
