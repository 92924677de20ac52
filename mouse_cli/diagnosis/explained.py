"""Fits as the answer gives them: their mechanisms, sites and sizes in words and numbers."""

import numpy as np

from mouse_cli.diagnosis.companions import Shared
from mouse_cli.diagnosis.search.fit import Fit
from mouse_cli.diagnosis.search.rank import Ranking, group
from mouse_cli.diagnosis.verdict import member
from mouse_cli.model.diagnosis import Cause, Certain, Explanation, Size
from mouse_cli.model.explanation import Places
from mouse_cli.model.site import as_read
from mouse_cli.model.units import Units
from mouse_cli.updating.chi_square import upper_tail

_LEAST = 1e-3  # share of a site below which it is no matter


def explanations(ranking: Ranking) -> tuple[Explanation, ...]:
    """All fits in words and numbers; what stands for a group is what a verdict takes of it."""
    named = [(ranking.fits[i], float(ranking.probabilities[i])) for i in ranking.named]
    stand = {id(member(ranking, name)) for name in {group(one) for one, _ in named}}
    return tuple(explanation(one, p, id(one) in stand) for one, p in named)


def explanation(one: Fit, probability: float = 0.0, stands: bool = False) -> Explanation:
    """A fit as the report gives it."""
    causes = _causes(one)
    theta = one.model.base.parameters(one.point.x[: one.model.k])
    p = upper_tail(one.misfit, max(one.dof, 1))
    return Explanation(causes, one.misfit, one.dof, p, one.log_evidence, theta, probability, _elsewhere(one), stands)


def _elsewhere(one: Fit) -> Places:
    """Other sites of a fit and their probabilities: optima that read alike are one, and none is its own."""
    found: dict[tuple, list] = {}
    for other, share in one.elsewhere:
        found.setdefault(as_read(other.sites), [other.sites, 0.0])[1] += share
    found.pop(as_read(one.sites), None)
    return tuple((sites, share) for sites, share in found.values() if share > _LEAST)


def certain(one: Fit, found: Shared) -> Certain:
    """What is certain of a fit, in words and numbers, in the order of `Explanation`."""
    causes = _causes(one)
    chosen = sorted((causes[i] for i in found.which), key=lambda cause: (cause.group, cause.physics))
    return Certain(tuple(chosen), found.probability, found.members, found.companions)


def _causes(one: Fit) -> tuple[Cause, ...]:
    """The mechanisms of a fit, in its order."""
    sd, units = np.sqrt(np.abs(np.diag(one.covariance)))[one.model.k :], one.model.base.problem.units
    parts = zip(one.recipes, one.groups, one.model.own, strict=True)
    return tuple(_cause(recipe, group, one.c[own], sd[own], units) for recipe, group, own in parts)


def acting(one: Fit) -> str:
    """Where the mechanisms of a fit act, in words."""
    return " + ".join(site.text or f"{site.kind} {', '.join(map(str, site.ids))}" for site in one.sites)


def _cause(recipe, group: str, c: np.ndarray, sd: np.ndarray, units: Units) -> Cause:
    values = recipe.values(c)
    sizes = tuple(
        Size(u.name, units.of(u.unit), float(v), float(s * v if u.log else s), u.lower, u.upper)
        for u, v, s in zip(recipe.unknowns, values, sd, strict=True)
    )
    candidate = recipe.candidate
    return Cause(candidate.key, group, recipe.title(values) or candidate.title, recipe.site(values), sizes, recipe.law)
