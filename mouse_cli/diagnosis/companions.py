"""What most explanations share: mechanisms that are certain while what acts beside them is open.

"Crack and gravity", "crack and tension" and "crack" are three groups and one crack. Explanations exclude one another, so that the
probability of a mechanism is the sum of those of all explanations that have its group at its site.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations
from math import erf, sqrt

import numpy as np

from mouse_cli.diagnosis.effects.change import PLACE, Recipe
from mouse_cli.diagnosis.gates import OPEN, SAME_SITE, SURE
from mouse_cli.diagnosis.likelihoods.modal.scales import span
from mouse_cli.diagnosis.search.fit import Fit
from mouse_cli.diagnosis.search.rank import Ranking
from mouse_cli.model.groups import joined, shares
from mouse_cli.model.shared_place import panels
from mouse_cli.model.site import Site, gap

CARRIES = 0.9  # share of what a set takes of the misfit from which on one mechanism carries it

Mechanism = tuple[str, str, Site]  # physics, group, site


@dataclass(frozen=True)
class Shared:
    """Mechanisms of a fit, by number, that other explanations have too; probability of all that have them.

    members, companions: physics of theirs, and groups of what else acts, each with its probability given them.
    """

    which: tuple[int, ...]
    probability: float
    members: tuple[tuple[str, float], ...]
    companions: tuple[tuple[str, float], ...]


def shared(ranking: Ranking, first: Fit) -> Shared | None:
    """The most mechanisms of `first` that are probable enough together, of those at a sure place, if any is; None: none has it.

    SURE is enough beside companions that are as sure, OPEN where these are open.
    """
    own, every = _mechanisms(first), list(_explanations(ranking))
    reach = SAME_SITE * span(first.model.base)
    kept = steady(first) or tuple(range(len(own)))
    for count in range(len(kept), 0, -1):
        found = [_summed(which, own, every, reach) for which in combinations(kept, count)]
        best = max(found, key=lambda one: one.probability)
        if best.probability >= (SURE if max((p for _, p in best.companions), default=0.0) >= SURE else OPEN):
            return best
    return None


def carrying(ranking: Ranking, first: Fit) -> Shared | None:
    """The one mechanism of a set that by itself takes away nearly all of the misfit (CARRIES), with what else acts as it is shared.

    None: none does. Where a set is refuted, that one mechanism stands, and what acts beside it is open.
    """
    own, every, reach = _mechanisms(first), list(_explanations(ranking)), SAME_SITE * span(first.model.base)
    none, least = ranking.baseline.misfit, CARRIES * (ranking.baseline.misfit - first.misfit)
    enough = [one for one in ranking.fits if len(one.recipes) == 1 and none - one.misfit > least]
    for i in steady(first):
        dofs = set(first.recipes[i].dofs)
        if any(dofs & set(one.recipes[0].dofs) or _matched([own[i]], _mechanisms(one), reach) for one in enough):
            return _summed((i,), own, every, reach)
    return None


def placed(one: Fit) -> float:
    """Share of the evidence of a fit at its own sites, or so near that they are one (SAME_SITE), or at these and more parts.

    A foot is flexible too where another, hardly so, is counted with it, and a member where it is the row that it belongs to.
    """
    own, reach = _mechanisms(one), SAME_SITE * span(one.model.base)
    apart = lambda other: _matched(own, _mechanisms(other), reach) is None and not _among(one, other)
    return 1 - sum(share for other, share in one.elsewhere if apart(other))


def _among(one: Fit, other: Fit) -> bool:
    """Whether the mechanisms of two fits are the same, but for parts or elements that those of `other` have besides."""
    if len(one.recipes) != len(other.recipes):
        return False
    pairs = zip(one.recipes, other.recipes, _mechanisms(one), _mechanisms(other), strict=True)
    return all(
        a[0] == b[0] and ((own.dofs and set(own.dofs) <= set(its.dofs)) or _whole(own, a[2], b[2]))
        for own, its, a, b in pairs
    )


def _whole(own: Recipe, site: Site, other: Site) -> bool:
    """Whether a mechanism that acts on whole elements acts on them at another site too, which has more of them in one row."""
    spread = site.kind == other.kind == "element" and None not in (site.position, other.position)
    return spread and set(site.ids) < set(other.ids) and all(unknown.name != PLACE for unknown in own.unknowns)


def panelled(one: Fit) -> bool:
    """Whether all sites that hold SURE of the evidence of a fit join two nodes across one line of panels.

    One diagonal of a panel does what the other does, and where floors hardly stretch one bay of a storey what the next does.
    """
    shares = [(1 - sum(share for _, share in one.elsewhere), one), *((share, other) for other, share in one.elsewhere)]
    total, sites = 0.0, []
    for share, each in sorted(shares, key=lambda item: -item[0]):
        total, sites = total + share, [*sites, tuple((group, site) for _, group, site in _mechanisms(each))]
        if total >= SURE:
            break
    moved = [own for own in zip(*sites, strict=True) if len(set(own)) > 1]
    if len(moved) != 1 or not all(_diagonal(*each) for each in moved[0]):
        return False
    return panels(one.model.base.problem.mesh, [site for _, site in moved[0]])


def _diagonal(group: str, site: Site) -> bool:
    """Whether a mechanism joins two nodes, or two pairs of them that cross."""
    return site.kind == "node" and len(site.ids) in ((2, 4) if group == "brace" else (2,))


def loose(one: Fit, which: tuple[int, ...] | None = None) -> tuple[tuple[str, float], ...]:
    """Title, and posterior sd (m) of the place along its line, of each mechanism (of those numbered `which`) whose place is less
    sure than a name is: that it is as near as two that are one (SAME_SITE).
    """
    return tuple((one.recipes[i].candidate.title, sd) for i, sd in _loose(one) if which is None or i in which)


def steady(one: Fit) -> tuple[int, ...]:
    """Numbers of the mechanisms of a set that are not loose; of one alone, which is named with the sd of its place, that one."""
    moving = {i for i, _ in _loose(one)} if len(one.recipes) > 1 else ()
    return tuple(i for i in range(len(one.recipes)) if i not in moving)


def _loose(one: Fit) -> list[tuple[int, float]]:
    """Number of each loose mechanism, and the sd of its place."""
    sd, reach = np.sqrt(np.diag(one.covariance))[one.model.k :], SAME_SITE * span(one.model.base)
    return [
        (i, float(s))
        for i, (recipe, own) in enumerate(zip(one.recipes, one.model.own, strict=True))
        for unknown, s in zip(recipe.unknowns, sd[own], strict=True)
        if unknown.name == PLACE and erf(reach / (s * sqrt(2))) < SURE
    ]


def _summed(which: tuple[int, ...], own: list[Mechanism], every, reach: float) -> Shared:
    physics, others, weights = [], [], []
    for p, mechanisms in every:
        at = _matched([own[i] for i in which], mechanisms, reach)
        if at is not None:
            physics.append(" + ".join(sorted(mechanisms[i][0] for i in at)))
            others.append(joined([group for i, (_, group, _) in enumerate(mechanisms) if i not in at]))
            weights.append(p)
    total = sum(weights)
    given = [p / total for p in weights] if total > 0 else weights
    return Shared(which, total, shares(physics, given), shares(others, given))


def _explanations(ranking: Ranking) -> Iterator[tuple[float, list[Mechanism]]]:
    """Probability and mechanisms of all fits that have a name, each at all of its sites."""
    for i in ranking.named:
        one, p = ranking.fits[i], float(ranking.probabilities[i])
        for other, share in one.elsewhere:
            yield p * share, _mechanisms(other)
        yield p * (1 - sum(share for _, share in one.elsewhere)), _mechanisms(one)


def _mechanisms(one: Fit) -> list[Mechanism]:
    return [(recipe.candidate.key, *at) for recipe, *at in zip(one.recipes, one.groups, one.sites, strict=True)]


def _matched(wanted: Sequence[Mechanism], among: Sequence[Mechanism], reach: float) -> tuple[int, ...] | None:
    """Numbers of those `among` that are the ones wanted, each one once, the nearest first; None where one is not there."""
    taken: tuple[int, ...] = ()
    for _, group, site in wanted:
        gaps = [
            (gap(site, other), i)
            for i, (_, its, other) in enumerate(among)
            if its == group and i not in taken and gap(site, other) <= reach
        ]
        if not gaps:
            return None
        taken += (min(gaps)[1],)
    return taken
