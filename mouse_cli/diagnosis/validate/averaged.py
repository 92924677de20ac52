"""What has no name predicts as all hypotheses together do, each as probable as the data make it.

p(y | D) = sum_i P(H_i | D) p(y | H_i, D) (Hoeting, Madigan, Raftery and Volinsky, Statistical Science 14, 1999). A frequency is the
median of that, which vague predictions of little weight do not move, its sd that of a normal distribution with as wide a 90 %
interval. Where a mode is left out, each hypothesis is fitted and weighed without it. What a hypothesis leaves beyond the stated
noise scales that, and what it knows of its own unknowns.

Where the data refute all of them, none is true, and how probable each is says little of what it predicts. Each is then fitted
without each of the other modes in turn; its errors e_k of those n frequencies (of ln f) have one sd s, unknown, p(s) ~ 1 / s:

    w_i ~ integral of s^-n exp(-sum_k e_ki^2 / 2 s^2) ds / s ~ (sum_k e_ki^2)^(-n/2),     variance = sum_k e_ki^2 / (n - 2)

(cross-validated weights: Yao, Vehtari, Simpson and Gelman, Bayesian Analysis 13, 2018; the variance is that of Student's t).
Errors elsewhere say nothing of a mode that the others leave open: the variance v_i by which a hypothesis itself knows the mode
counts as theirs do, w_i ~ (sum_k e_ki^2 + n v_i)^(-n/2).
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from mouse_cli.diagnosis.gates import GATE
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.noise import log_density, scale
from mouse_cli.diagnosis.search.fit import Fit
from mouse_cli.diagnosis.search.moves import adequate
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
_TAIL, _FAR = 0.05, 4.0  # beyond either end of a 90 % interval, and how many sd from all predictions no quantile is
_SHARP = 1e-9  # Hz, below which no sd counts
_HALVINGS = 60  # of the interval that a quantile lies in
_REFUTED = 3  # of refuted hypotheses with a name, and of those without, that are averaged


@dataclass(frozen=True)
class Member:
    """A hypothesis, and ln of how probable it is."""

    fit: Fit
    weight: float


def members(ranking: Ranking) -> list[Member]:
    """The fits most probable by the fitted data, and that of no mechanism; those of one rival at other spreads, lengths and sites
    each for itself.
    """
    every: list[tuple[Fit, float]] = []
    by_fitted = ranking.probabilities if ranking.by_fitted is None else ranking.by_fitted
    for one, p in zip(ranking.fits, by_fitted.tolist(), strict=True):
        own = 1 - sum(share for _, share in one.variants)
        every += [(one, p * own), *((each, p * share) for each, share in one.variants)]
    every = sorted(every, key=lambda each: -each[1])
    least = _LEAST * sum(p for _, p in every[:_MOST])
    chosen = every[:_MOST] + [each for each in every[_MOST:] if each[0] is ranking.baseline]
    return [Member(one, float(np.log(p))) for one, p in chosen if p > max(least, 0.0)]


def averaged(model: Reduced, ranking: Ranking) -> HeldOut | None:
    """How the model as it is, and all hypotheses together, predict what the deck holds out, else each mode from the others."""
    own = members(ranking)
    if refuted := not any(adequate(one.fit, GATE) for one in own):
        own = [Member(one, 0.0) for one in _refuted(ranking)]
    return (_by_deck if by_deck(model) else _by_mode)(model, ranking.baseline, own, refuted)


def _refuted(ranking: Ranking) -> list[Fit]:
    """The most probable with a name, those without, and the model as it is."""
    others = [one for one in ranking.fits if one is not ranking.baseline]
    of = lambda nameless: [one for one in others if bool(one.nameless) is nameless][:_REFUTED]
    return [*of(False), *of(True), ranking.baseline]


def _by_deck(model: Reduced, baseline: Fit, own: list[Member], refuted: bool) -> HeldOut | None:
    held = model.problem.hold_out
    before = of_cases(held, baseline)
    each = [(one, _tried(one.fit) if refuted else None, of_cases(held, one.fit, _noise(one.fit))) for one in own]
    labels, old, new = [], [], []
    for i, (title, part) in enumerate(before):
        predicted = [_weighed(one.weight, cases[i][1], off) for one, off, cases in each if cases[i][1] is not None]
        if part is not None and predicted:
            labels += [title.format(number) for number in part.test.number]
            old.append(part), new.append(_mixed(predicted))
    if not old:
        return None
    measured = np.concatenate([part.test.frequency_hz for part in old])
    return HeldOut(BY_DECK, tuple(labels), measured, score(old), score(new))


def _by_mode(model: Reduced, baseline: Fit, own: list[Member], refuted: bool) -> HeldOut | None:
    test = model.data.test
    if test.m < 3:
        return None
    own = [
        replace(one, weight=one.weight - _evidence(again)) for one in own if (again := refitted(one.fit)) is not None
    ]
    old, new = [], []
    for i in range(test.m):
        before, predicted = left_out(baseline, i), []
        for one in own:
            again, part = _without(one.fit, i)
            if part is not None:
                predicted.append(_weighed(one.weight + _evidence(again), part, _tried(again) if refuted else None))
        if before is None or not predicted:
            return None
        old.append(before), new.append(_mixed(predicted))
    labels = tuple(f"mode {number}" for number in test.number)
    return HeldOut(BY_MODE, labels, test.frequency_hz, score(old), score(new))


def _without(one: Fit, i: int) -> tuple[Fit | None, Prediction | None]:
    """A hypothesis fitted without measured mode i, and what it then says of it."""
    again = refitted(one, i)
    return again, again and predict(again, one.model.base.left_out(i), noise=_noise(again))


def _tried(one: Fit) -> list[float]:
    """Errors (n,) of ln f of a refuted hypothesis, see above; an infinite one where it cannot predict some mode."""
    off = []
    for k in np.flatnonzero(one.data.has_frequency).tolist():
        part = _without(one, k)[1]
        ratio = 0.0 if part is None else float(part.hz[0] / part.test.frequency_hz[0])
        off.append(float(np.log(ratio)) if ratio > 0 else np.inf)
    return off


def _weighed(weight: float, part: Prediction, off: list[float] | None) -> tuple[float, Prediction]:
    """ln w of a prediction, and itself with what its errors `off` elsewhere ask for; None: it is not refuted, `weight` holds."""
    if off is None:
        return weight, part
    total, n = float(np.sum(np.square(off))), len(off)
    if not np.isfinite(total):
        return -np.inf, part
    known = np.isfinite(part.sd_hz)
    own = float(np.mean((part.sd_hz / part.hz)[known] ** 2)) if known.any() else 0.0
    return -0.5 * n * float(np.log(total + n * own + np.finfo(float).tiny)), _widened(part, total / max(n - 2, 1))


def _widened(part: Prediction, error: float) -> Prediction:
    """The same, its variances by one factor larger where the frequencies ask for it."""
    known = np.isfinite(part.sd_hz) & (part.sd_hz > 0)
    s = max(1.0, error / np.mean((part.sd_hz / part.hz)[known] ** 2)) if known.any() else 1.0
    density = part.density + 0.5 * (part.misfit * (1 - 1 / s) - part.dof * np.log(s))
    return replace(part, sd_hz=np.sqrt(s) * part.sd_hz, misfit=part.misfit / s, density=float(density))


def _evidence(one: Fit) -> float:
    """ln Z, noise larger than stated integrated out."""
    return one.log_evidence + 0.5 * one.misfit + float(log_density(np.array(one.misfit), one.dof))


def _noise(one: Fit) -> float:
    return scale(one.misfit, one.dof)


def _mixed(predicted: Sequence[tuple[float, Prediction]]) -> Prediction:
    """One prediction of several, with ln of their weights."""
    log = np.array([weight for weight, _ in predicted])
    log = log if np.isfinite(log).any() else np.zeros(len(log))
    log -= np.logaddexp.reduce(log)
    p, parts = np.exp(log), [part for _, part in predicted]
    mean = lambda name: sum(w * getattr(part, name) for w, part in zip(p, parts, strict=True))
    each, spread = (np.array([getattr(part, name) for part in parts]) for name in ("hz", "sd_hz"))
    hz, test = np.where(np.isfinite(spread).all(axis=0), _quantile(each, spread, p, 0.5), mean("hz")), parts[0].test
    low, high = (_quantile(each, spread, p, share) for share in (_TAIL, 1 - _TAIL))
    known = np.isfinite(test.frequency_hz) & np.isfinite(high)
    covered = ((low < test.frequency_hz) & (test.frequency_hz < high))[known]
    density = float(np.logaddexp.reduce(log + np.array([part.density for part in parts])))
    rest = (float(mean("misfit")), parts[0].dof, mean("shape_error"))
    return Prediction(test, hz, (high - low) / (2 * COVERED), mean("mac"), density, covered, *rest)


def _quantile(hz: np.ndarray, sd: np.ndarray, p: np.ndarray, share: float) -> np.ndarray:
    """Quantile (m,) of each mixture of normal distributions (h, m) with weights p (h,), by bisection; nan where no sd is known."""
    from scipy.special import ndtr

    low, high = (hz - _FAR * sd).min(axis=0), (hz + _FAR * sd).max(axis=0)
    for _ in range(_HALVINGS):
        middle = 0.5 * (low + high)
        below = p @ ndtr((middle - hz) / np.maximum(sd, _SHARP)) < share
        low, high = np.where(below, middle, low), np.where(below, high, middle)
    return 0.5 * (low + high)
