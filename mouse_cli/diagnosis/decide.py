"""What may be said: nothing is missing, it is this, it is one of these, or something no candidate explains."""

import numpy as np

from mouse_cli.diagnosis.fit import Fit
from mouse_cli.diagnosis.name import Ranking
from mouse_cli.model.diagnosis import BY_DECK, NAMED, NOTHING, ONE_OF, UNKNOWN, Cause, Explanation, HeldOut, Size
from mouse_cli.model.result import Result
from mouse_cli.model.units import Units
from mouse_cli.updating.chi_square import upper_tail

GATE = 1e-3  # probability of so large a misfit by chance, below which something is missing
_SURE = 0.9  # probability of a group from which on it is named
_ODDS = 3.0  # nats over no cause at all that a name needs
_INADEQUATE = 1.5  # noise scale of the best explanation above which it is none


def doubtful(baseline: Fit, result: Result) -> bool:
    """Whether what the update leaves is no chance: misfit, shift of the parameters, or both together."""
    return result.rejected or upper_tail(baseline.misfit, baseline.dof) < GATE


def decide(ranking: Ranking, result: Result) -> str:
    """The kind of answer, by the gates of adequacy, probability and odds."""
    if not doubtful(ranking.baseline, result):
        return NOTHING
    leader, (name, probability) = ranking.fits[0], ranking.groups[0]
    dof = max(leader.dof, 1)
    if upper_tail(leader.misfit, dof) < GATE and leader.misfit > _INADEQUATE * dof:
        return UNKNOWN
    if not leader.model.base.data.by_shape and any(recipe.own for recipe in leader.recipes):
        return ONE_OF  # paired by number, a list of frequencies cannot prove that it holds one mode more
    if probability < _SURE:
        return ONE_OF
    if name == "none":
        return UNKNOWN
    odds = (leader.log_evidence - ranking.baseline.log_evidence) / ranking.noise_scale
    return NAMED if odds > _ODDS else ONE_OF


def refuted(proof: HeldOut | None) -> bool:
    """Whether data that were held out are predicted worse with the cause than without: then it is no name."""
    if proof is None or proof.revised is None or proof.kind != BY_DECK:
        return False
    return proof.revised.log_predictive_density < proof.baseline.log_predictive_density - _ODDS


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
    return Explanation(causes, one.misfit, one.dof, p, one.log_evidence, theta, probability)


def _cause(recipe, c: np.ndarray, sd: np.ndarray, units: Units) -> Cause:
    values = recipe.values(c)
    sizes = tuple(
        Size(u.name, units.of(u.unit), float(v), float(s * v if u.log else s), u.lower, u.upper)
        for u, v, s in zip(recipe.unknowns, values, sd, strict=True)
    )
    candidate = recipe.candidate
    return Cause(candidate.key, candidate.group, candidate.title, recipe.site(values), sizes)
