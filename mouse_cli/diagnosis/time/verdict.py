"""What may be said: probabilities of laws and places, and the gates of adequacy, probability and odds."""

from dataclasses import dataclass

import numpy as np

from mouse_cli.diagnosis.time.polish import Fit
from mouse_cli.diagnosis.time.study import adequate, missing
from mouse_cli.model.diagnosis import (
    NAMED,
    NOTHING,
    ONE_OF,
    UNKNOWN,
    Cause,
    Explanation,
    Size,
)
from mouse_cli.updating.chi_square import upper_tail

_PRIOR = 0.3, 0.7  # that nothing is missing, that one law is
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
        found: dict[str, float] = {}
        for one, p in zip(self.fits, self.probabilities, strict=True):
            found[group(one)] = found.get(group(one), 0.0) + float(p)
        return tuple(sorted(found.items(), key=lambda item: -item[1]))

    @property
    def best(self) -> Fit | None:
        """The most probable fit with a law."""
        return next((one for one in self.fits if one.hypothesis.law), None)


def group(one: Fit) -> str:
    """Group of its law, `none` without."""
    return one.hypothesis.law.group if one.hypothesis.law else "none"


def ranked(baseline: Fit, fits: list[Fit]) -> Ranking:
    """Probabilities with the noise scale that the best fit needs."""
    every = [baseline, *fits]
    scale = max(1.0, min(one.misfit / one.dof for one in every))
    names = [group(one) for one in every]
    kinds = max(len({*names} - {"none"}), 1)
    prior = [_PRIOR[0] if name == "none" else _PRIOR[1] / kinds / names.count(name) for name in names]
    weights = np.log(prior) + np.array([one.log_evidence for one in every]) / scale
    order = np.argsort(-weights)
    weights = np.exp(weights - weights.max())
    weights /= weights.sum()
    return Ranking(baseline, tuple(every[i] for i in order), scale, weights[order])


def decided(ranking: Ranking, ratio: float) -> str:
    """The kind of answer; ratio: error on held-out records with the cause over that without, nan where there are none."""
    best = ranking.best
    if not missing(ranking.baseline):
        return NOTHING
    if best is None or not adequate(ranking.fits[0]) or ranking.groups[0][0] == "none":
        return UNKNOWN
    odds = (best.log_evidence - ranking.baseline.log_evidence) / ranking.noise_scale
    same = sum(
        p
        for one, p in zip(ranking.fits, ranking.probabilities, strict=True)
        if group(one) == group(best) and one.hypothesis.place.site == best.hypothesis.place.site
    )
    if same < _SURE or odds <= _ODDS or ratio > _BETTER:
        return ONE_OF
    return NAMED


def explanation(one: Fit, probability: float, theta: np.ndarray) -> Explanation:
    """A fit as reports give it."""
    dof = max(int(one.dof), 1)
    return Explanation(causes(one), one.misfit, dof, upper_tail(one.misfit, dof), one.log_evidence, theta, probability)


def causes(one: Fit) -> tuple[Cause, ...]:
    """Its law at its place, with its sizes."""
    law, place = one.hypothesis.law, one.hypothesis.place
    if law is None:
        return ()
    unknowns = one.hypothesis.unknowns
    values = one.hypothesis.parameters(one.x[None])[:, 0]
    sd = np.sqrt(np.abs(np.diag(one.covariance)))[-len(unknowns) :]
    sizes = tuple(
        Size(u.name, u.unit, float(v), float(v * s), u.lower, u.upper)
        for u, v, s in zip(unknowns, values, sd, strict=True)
    )
    word = law.words[one.hypothesis.variant]
    title = f"{law.title} ({word})" if word else law.title
    return (Cause(law.key, law.group, title, place.site, sizes),)
