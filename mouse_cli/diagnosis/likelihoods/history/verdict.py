"""What may be said: probabilities of laws and places, and the gates of adequacy, probability and odds."""

from dataclasses import dataclass, replace

import numpy as np

from mouse_cli.diagnosis.gates import FAR, ODDS, SURE
from mouse_cli.diagnosis.gates import MATERIAL as GAINED
from mouse_cli.diagnosis.likelihoods.history.search import Weighed
from mouse_cli.diagnosis.search.rank import Ranking, group, ranking
from mouse_cli.diagnosis.verdict import leader
from mouse_cli.model.channel_units import read_as
from mouse_cli.model.diagnosis import NAMED, NOTHING, ONE_OF, RIVAL, UNKNOWN, Explanation, Rest, Untried
from mouse_cli.terms.laws import Law, registry
from mouse_cli.updating.chi_square import upper_tail
from mouse_cli.updating.recordings.adequacy import (
    MATERIAL,
    adequate,
    close,
    innovation,
    missing,
    shift_p,
    shifted,
    strained,
    unlikely,
)
from mouse_cli.updating.recordings.channels import Misreading, misreadings
from mouse_cli.updating.recordings.fit import Fit
from mouse_cli.updating.recordings.regression import allowed
from mouse_cli.updating.recordings.rotations import spelled
from mouse_cli.updating.recordings.study import Study

_BETTER = 0.7  # ratio of errors on held-out records, noise taken out, that a name takes
_WORSE = 1.1  # such a ratio that refutes a law although the records alone do not speak against the model as it is
_MOST = 0.5  # share of a misfit that a law must take to be named although more than noise remains
_FAR_OVER = 10 * ODDS  # nats over no cause that such a name takes


def ranked(found: Weighed) -> Ranking:
    """Probabilities as of every kind of test; coloured noise counts by the share of its samples that are independent."""
    every = _telling(_sound([found.baseline, *_once(found.fits, found.beside)]), found.beside)
    share = 1.0 if found.noise is None else found.noise.effective
    less = lambda one: replace(
        one, misfit=share * one.misfit, dof=share * one.dof, log_evidence=share * one.log_evidence
    )
    views = [less(one) for one in every]
    again, whole = ranking(views[0], views), {id(view): one for view, one in zip(views, every, strict=True)}
    fits = tuple(whole[id(view)] for view in again.fits)
    return replace(again, baseline=found.baseline, fits=fits, noise_scale=again.noise_scale / share)


def _once(fits: list[Fit], beside: Fit | None) -> list[Fit]:
    """Of the ends of one hypothesis, begun in several ways, the most probable; `beside` where it is one of them."""
    best: dict[tuple, Fit] = {}
    for one in sorted(fits, key=lambda one: (one is not beside, -one.log_evidence)):
        best.setdefault(tuple((part.law.key, part.variant, part.place.where) for part in one.hypothesis.parts), one)
    return [one for one in fits if any(one is each for each in best.values())]


def _sound(every: list[Fit]) -> list[Fit]:
    """`every` without laws that explain the records with parameters further from their prior than FAR, where one does without."""
    if not any(adequate(one) for one in every[1:]):
        return every
    return [one for one in every if one is every[0] or not (np.abs(shifted(one)) > FAR).any()]


def _telling(every: list[Fit], beside: Fit | None) -> list[Fit]:
    """`every` without pairs that say nothing: those that neither explain the records nor take most of what the best law leaves, or
    that gain less than MATERIAL over one of their laws, which explains them alone.

    Where no pair explains them, those that hold the best law at its site say no more than that it is there: it is judged alone,
    with what remains. beside: the fit that leaves noise, which explains them too.
    """
    count = lambda one: len(one.hypothesis.parts)
    alone = min((one for one in every if count(one) == 1), key=_excess, default=None)
    if alone is None:
        return every
    explains = lambda one: adequate(one) or one is beside
    unexplained = not any(explains(one) for one in every if count(one) > 1)
    says = lambda one: (
        explains(one) or (_excess(one) <= _MOST * _excess(alone) and not (unexplained and _sites(alone) <= _sites(one)))
    )
    enough = [one for one in every if count(one) == 1 and explains(one)]
    needed = lambda one: not any(
        _sites(law) <= _sites(one) and one.log_evidence < law.log_evidence + GAINED for law in enough
    )
    return [one for one in every if count(one) < 2 or (says(one) and needed(one))]


def _excess(one: Fit) -> float:
    """Innovation above what chance makes of it."""
    return max(innovation(one) - one.dof, 0.0)


@dataclass(frozen=True)
class Decision:
    """kind of answer; rest: what a named law leaves; refuted: groups by held-out records; cautions: sentences."""

    kind: str
    rest: Rest | None = None
    refuted: tuple[str, ...] = ()
    cautions: tuple[str, ...] = ()


def decided(ranking: Ranking, found: Weighed, ratio: float, free: bool = False, whole: bool = True) -> Decision:
    """What may be said; ratio: error on held-out records with the cause over that without, nan where they do not judge.

    free: of free decays, whose loud beginning is one stretch or two: a law that leaves more than noise there may stand for another.
    whole: whether all laws were tried. The model as it is is held to what a law is held to: where none of them has a log evidence
    over none, it is adequate if it leaves no more than a law may. What explains the records otherwise pushes parameters too.
    """
    best, first = leader(ranking), ranking.fits[0]
    if not missing(ranking.baseline) or found.beside is found.baseline:
        return Decision(NOTHING)
    if found.otherwise:
        return Decision(UNKNOWN)
    if distant := far(first, ranking.noise_scale):
        return Decision(UNKNOWN, cautions=(_distant(distant),))
    if best is None or ranking.groups[0][0] == "none":
        sound = whole and first is ranking.baseline and adequate(first)
        return Decision(NOTHING if sound else UNKNOWN)
    if not unlikely(ranking.baseline) and not ratio > _WORSE:
        ratio = np.nan  # parameters pushed out of their prior predict as well as what is true
    if ratio > 1:
        return Decision(UNKNOWN, None, (group(best),), (_refuted(best, ratio),))
    rest = None if free or _settled(ranking, found) else _rest(ranking)
    named = _sure(ranking) and not ratio > _BETTER
    if not _settled(ranking, found) and (rest is None or not named):
        return Decision(UNKNOWN)
    return Decision(NAMED, rest) if named else Decision(ONE_OF)


def _settled(ranking: Ranking, found: Weighed) -> bool:
    """Whether the leading fit leaves no more than noise, of the channels or of its own, with parameters that may be."""
    first, beside = ranking.fits[0], found.beside
    explained = close(first) or (beside is not None and first.misfit <= MATERIAL * beside.misfit)
    return explained and not strained(first, ranking.noise_scale)


def _odds(ranking: Ranking) -> float:
    best = leader(ranking)
    return float(ranking.log_odds[next(i for i, one in enumerate(ranking.fits) if one is best)])


def _sure(ranking: Ranking) -> bool:
    """Whether the group of the leading law, at its place, is probable enough for a name."""
    best = leader(ranking)
    same = sum(
        p
        for one, p in zip(ranking.fits, ranking.probabilities, strict=True)
        if group(one) == group(best) and _sites(one) == _sites(best)
    )
    return same >= SURE and _odds(ranking) > ODDS


def _rest(ranking: Ranking) -> Rest | None:
    """What the leading law leaves where it takes most of the misfit without a rival; None where it may stand for something else.

    Two laws that do not do together, and modes of their own, take much of any force that nobody thought of; a negative spring of
    whatever gives in series with the structure, as a base that rocks.
    """
    best, (_, *others) = leader(ranking), ranking.groups
    share = _excess(best) / max(_excess(ranking.baseline), 1e-300)
    parts = best.hypothesis.parts
    if len(parts) > 1 or any(part.extra or part.law.solitary for part in parts):
        return None
    if share > 1 - _MOST or _odds(ranking) <= _FAR_OVER or any(p > RIVAL for _, p in others):
        return None
    return Rest(share, min(upper_tail(best.misfit, max(int(best.dof), 1)), shift_p(best, ranking.noise_scale)))


def far(one: Fit, scale: float) -> tuple[str, ...]:
    """The nuisances beyond FAR, in words, the furthest first."""
    z = shifted(one, scale)
    names = one.hypothesis.names
    order = np.argsort(-np.abs(z))
    return tuple(f"{names[i]} is {z[i]:+.1f} prior sd from its mean" for i in order if abs(z[i]) > FAR)


def _distant(distant: tuple[str, ...]) -> str:
    return (
        f"No fit is accepted whose parameters are more than {FAR:g} prior sd from their mean: {'; '.join(distant)}. "
        "Check the deck there before you look for missing physics, or widen the prior if it was stated too narrow."
    )


def _refuted(best: Fit, ratio: float) -> str:
    titles = " and ".join(part.title for part in best.hypothesis.parts)
    how = (
        f"whose error is {ratio:.3g} times that of the model as it is"
        if ratio < np.inf
        else "whose simulation with it diverges"
    )
    return f"Refuted by records that no fit has seen, {how}: {titles}."


def remedies(one: Fit | None, own: Study) -> tuple[str, ...]:
    """What to do about the errors of channels that a fit has."""
    found, channels = [], (*own.records.outputs, *own.records.inputs)
    for part, p in [] if one is None else one.hypothesis.sizes(one.x[None]):
        if not isinstance(part.law, Misreading):
            continue
        channel, (gain, delay) = channels[part.place.channel], part.law.reads(p[:, 0], **part.words)
        if part.law.key == "sensor-delay":
            found.append(f"Channel {channel.name} is {1e3 * delay:.4g} ms late: shift it by so much in its file.")
            continue
        unit = read_as(channel.quantity, channel.unit, abs(gain))
        cause = f"; where its numbers are in {unit}, not in {channel.unit}, write unit: {unit}" if unit else ""
        sign = "; turn its sign" if gain < 0 else ""
        found.append(f"Channel {channel.name} reads {gain:.4g} times what it should{cause}{sign}.")
    return tuple(found)


def _sites(one: Fit) -> set[tuple[str, str]]:
    return {(cause.group, cause.site.text) for cause in one.causes}


def untried(found: Weighed, own: Study, known: list[Law] | None) -> tuple[Untried, ...]:
    """Laws that were left out (`known`: those that were not), have no site in the model, or were fitted and never shown."""
    every = (registry() | misreadings()).values()
    left = [law for law in every if known is not None and law.key not in {one.key for one in known}]
    shown = {part.law.key for one in found.fits for part in one.hypothesis.parts}
    placed = lambda law: own.channels if isinstance(law, Misreading) else [p for p in own.places if allowed(p, [law])]
    homeless = [law for law in every if law not in left and not placed(law)]
    return (
        *(Untried(law.key, "left out by the options of the diagnosis") for law in left),
        *(Untried(law.key, "no site in this model") for law in homeless if law.key != "iwan"),
        *(Untried(key, reason) for key, reason in found.dropped if key not in shown),
    )


def explanations(ranking: Ranking, own: Study) -> tuple[Explanation, ...]:
    """All fits as reports give them."""
    return tuple(_explanation(one, float(p), own) for one, p in zip(ranking.fits, ranking.probabilities, strict=True))


def _explanation(one: Fit, probability: float, own: Study) -> Explanation:
    dof, theta = max(int(one.dof), 1), own.model.theta(one.x[: own.model.own])
    causes = tuple(spelled(cause, own.problem) for cause in one.causes)
    return Explanation(causes, one.misfit, dof, upper_tail(one.misfit, dof), one.log_evidence, theta, probability)
