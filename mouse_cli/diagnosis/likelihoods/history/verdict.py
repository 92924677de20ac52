"""What may be said: probabilities of laws and places, and the gates of adequacy, probability and odds."""

from dataclasses import dataclass

import numpy as np

from mouse_cli.diagnosis.likelihoods.history.hypothesis import Part
from mouse_cli.diagnosis.likelihoods.history.polish import Fit
from mouse_cli.diagnosis.likelihoods.history.search import MATERIAL, Weighed, adequate, missing
from mouse_cli.model.diagnosis import (
    NAMED,
    NOTHING,
    ONE_OF,
    UNKNOWN,
    Cause,
    Explanation,
    Size,
)
from mouse_cli.model.groups import joined, shares
from mouse_cli.updating.chi_square import upper_tail

_PRIOR = 0.3, 0.6, 0.1  # that nothing is missing, one law, two
_SURE, _ODDS = 0.9, 3.0  # probability of a group, nats over no cause, that a name takes
_BETTER = 0.7  # ratio of errors on held-out records that a name takes


@dataclass(frozen=True)
class Ranking:
    """fits most probable first, the model as it is among them; probabilities (f,); noise_scale: s2; groups with theirs."""

    baseline: Fit
    fits: tuple[Fit, ...]
    noise_scale: float
    probabilities: np.ndarray

    @property
    def groups(self) -> tuple[tuple[str, float], ...]:
        """The largest first; `none` among them."""
        return shares([group(one) for one in self.fits], self.probabilities)

    @property
    def best(self) -> Fit | None:
        """The most probable fit with a law."""
        return next((one for one in self.fits if one.hypothesis.law), None)


def group(one: Fit) -> str:
    """Groups of its laws, `none` without."""
    return joined([part.law.group for part in one.hypothesis.parts])


def ranked(found: Weighed) -> Ranking:
    """Probabilities with the noise scale that the best fit needs: more where the noise is coloured, so that samples are not
    independent.
    """
    baseline, every = found.baseline, [found.baseline, *found.fits]
    scale = max(1.0, min(one.misfit / one.dof for one in every))
    if found.noise is not None:
        scale /= found.noise.effective
    names = [(len(one.hypothesis.parts), group(one)) for one in every]
    kinds = lambda count: len({name for name in names if name[0] == count})
    prior = [_PRIOR[name[0]] / kinds(name[0]) / names.count(name) for name in names]
    weights = np.log(prior) + np.array([one.log_evidence for one in every]) / scale
    order = np.argsort(-weights)
    weights = np.exp(weights - weights.max())
    weights /= weights.sum()
    return Ranking(baseline, tuple(every[i] for i in order), scale, weights[order])


def decided(ranking: Ranking, found: Weighed, ratio: float) -> str:
    """The kind of answer; ratio: error on held-out records with the cause over that without, nan where there are none."""
    best = ranking.best
    if not missing(ranking.baseline) or found.beside is found.baseline:
        return NOTHING
    first, beside = ranking.fits[0], found.beside
    settled = adequate(first) or (beside is not None and first.misfit <= MATERIAL * beside.misfit)
    if best is None or not settled or ranking.groups[0][0] == "none":
        return UNKNOWN
    odds = (best.log_evidence - ranking.baseline.log_evidence) / ranking.noise_scale
    same = sum(
        p
        for one, p in zip(ranking.fits, ranking.probabilities, strict=True)
        if group(one) == group(best) and _sites(one) == _sites(best)
    )
    if same < _SURE or odds <= _ODDS or ratio > _BETTER:
        return ONE_OF
    return NAMED


def _sites(one: Fit) -> set[tuple[str, str]]:
    return {(part.law.group, part.place.site.text) for part in one.hypothesis.parts}


def explanation(one: Fit, probability: float, theta: np.ndarray) -> Explanation:
    """A fit as reports give it."""
    dof = max(int(one.dof), 1)
    return Explanation(causes(one), one.misfit, dof, upper_tail(one.misfit, dof), one.log_evidence, theta, probability)


def causes(one: Fit) -> tuple[Cause, ...]:
    """Its laws at their places, with their sizes."""
    sd = np.sqrt(np.abs(np.diag(one.covariance)))[one.hypothesis.nuisances :]
    found = []
    for part, p in one.hypothesis.sizes(one.x[None]):
        own, sd = sd[: len(part.unknowns)], sd[len(part.unknowns) :]
        sizes = tuple(
            Size(u.name, u.unit, float(v), float(v * s), u.lower, u.upper)
            for u, v, s in zip(part.unknowns, p[:, 0], own, strict=True)
        )
        found.append(Cause(part.law.key, part.law.group, titled(part), part.place.site, sizes))
    return tuple(found)


def titled(part: Part) -> str:
    """A law and its variant in words."""
    word = part.law.words[part.variant]
    return f"{part.law.title} ({word})" if word else part.law.title
