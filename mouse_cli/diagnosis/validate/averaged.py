"""What has no name predicts as all hypotheses together do, each as probable as the data make it.

p(y | D) = sum_i P(H_i | D) p(y | H_i, D) (Hoeting, Madigan, Raftery and Volinsky, Statistical Science 14, 1999). A mean has the
variance of all predictions about it: sum_i P_i (sd_i^2 + (y_i - y)^2). Where a mode is left out, each hypothesis is fitted and
weighed without it. What a hypothesis leaves beyond the stated noise scales that, and what it knows of its own unknowns.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.noise import log_density, scale
from mouse_cli.diagnosis.search.fit import Fit
from mouse_cli.diagnosis.search.rank import Ranking
from mouse_cli.diagnosis.validate.held_out import (
    COVERED,
    Prediction,
    by_deck,
    left_out,
    of_cases,
    predict,
    refitted,
    score,
)
from mouse_cli.model.diagnosis import BY_DECK, BY_MODE, HeldOut

_MOST, _LEAST = 8, 1e-3  # hypotheses that are averaged, and the probability of the last of them


@dataclass(frozen=True)
class Member:
    """A hypothesis, and ln of how probable it is."""

    fit: Fit
    weight: float


def members(ranking: Ranking) -> list[Member]:
    """The fits most probable by the fitted data, no mechanism among them; those of one rival at other spreads, lengths and sites
    each for itself.
    """
    every: list[tuple[Fit, float]] = []
    by_fitted = ranking.probabilities if ranking.by_fitted is None else ranking.by_fitted
    for one, p in zip(ranking.fits, by_fitted.tolist(), strict=True):
        own = 1 - sum(share for _, share in one.variants)
        every += [(one, p * own), *((each, p * share) for each, share in one.variants)]
    every = sorted(every, key=lambda each: -each[1])[:_MOST]
    least = _LEAST * sum(p for _, p in every)
    return [Member(one, float(np.log(p))) for one, p in every if p > max(least, 0.0)]


def averaged(model: Reduced, ranking: Ranking) -> HeldOut | None:
    """How the model as it is, and all hypotheses together, predict what the deck holds out, else each mode from the others."""
    own = members(ranking)
    if not own:
        return None
    return _by_deck(model, ranking.baseline, own) if by_deck(model) else _by_mode(model, ranking.baseline, own)


def _by_deck(model: Reduced, baseline: Fit, own: list[Member]) -> HeldOut | None:
    held = model.problem.hold_out
    before = of_cases(held, baseline)
    each = [of_cases(held, one.fit, _noise(one.fit)) for one in own]
    labels, old, new = [], [], []
    for i, (title, part) in enumerate(before):
        told = [(one.weight, cases[i][1]) for one, cases in zip(own, each, strict=True) if cases[i][1] is not None]
        if part is not None and told:
            labels += [title.format(number) for number in part.test.number]
            old.append(part), new.append(_mixed(told))
    if not old:
        return None
    measured = np.concatenate([part.test.frequency_hz for part in old])
    return HeldOut(BY_DECK, tuple(labels), measured, score(old), score(new))


def _by_mode(model: Reduced, baseline: Fit, own: list[Member]) -> HeldOut | None:
    test = model.data.test
    if test.m < 3:
        return None
    own = [
        replace(one, weight=one.weight - _evidence(again)) for one in own if (again := refitted(one.fit)) is not None
    ]
    old, new = [], []
    for i in range(test.m):
        before, told = left_out(baseline, i), []
        for one in own:
            again = refitted(one.fit, i)
            part = None if again is None else predict(again, one.fit.model.base.left_out(i), noise=_noise(again))
            told += [] if part is None else [(one.weight + _evidence(again), part)]
        if before is None or not told:
            return None
        old.append(before), new.append(_mixed(told))
    labels = tuple(f"mode {number}" for number in test.number)
    return HeldOut(BY_MODE, labels, test.frequency_hz, score(old), score(new))


def _evidence(one: Fit) -> float:
    """ln Z, noise larger than stated integrated out."""
    return one.log_evidence + 0.5 * one.misfit + float(log_density(np.array(one.misfit), one.dof))


def _noise(one: Fit) -> float:
    return scale(one.misfit, one.dof)


def _mixed(told: Sequence[tuple[float, Prediction]]) -> Prediction:
    """One prediction of several, with ln of their weights."""
    log = np.array([weight for weight, _ in told])
    log -= np.logaddexp.reduce(log)
    p, parts = np.exp(log), [part for _, part in told]
    mean = lambda name: sum(w * getattr(part, name) for w, part in zip(p, parts, strict=True))
    hz = mean("hz")
    variance = sum(w * (part.sd_hz**2 + (part.hz - hz) ** 2) for w, part in zip(p, parts, strict=True))
    sd, test = np.sqrt(variance), parts[0].test
    known = np.isfinite(test.frequency_hz) & np.isfinite(sd)
    covered = np.abs(hz - test.frequency_hz)[known] < COVERED * sd[known]
    density = float(np.logaddexp.reduce(log + np.array([part.density for part in parts])))
    rest = (float(mean("misfit")), parts[0].dof, mean("shape_error"))
    return Prediction(test, hz, sd, mean("mac"), density, covered, *rest)
