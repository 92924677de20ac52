"""Every law at every place, weighed: the model as it is, first looks in closed form, fits by simulation, and a second law."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np

from mouse_cli.diagnosis.likelihoods.history.order import (
    POLISHED,
    alike,
    begun_again,
    elsewhere,
    from_mean,
    harder,
    others_there,
    varied,
    where,
)
from mouse_cli.diagnosis.likelihoods.history.shown import shown, undamped
from mouse_cli.model.record_diagnosis import Noise
from mouse_cli.terms.laws import Law
from mouse_cli.terms.laws import registry as laws
from mouse_cli.updating.recordings.acting import Place
from mouse_cli.updating.recordings.adequacy import adequate, innovation, missing, strained, unlikely, with_noise
from mouse_cli.updating.recordings.at_odds import odd
from mouse_cli.updating.recordings.changed import broken, changed
from mouse_cli.updating.recordings.channels import Misreading, misreadings
from mouse_cli.updating.recordings.disturbed import disturbed, unmeasured
from mouse_cli.updating.recordings.drift import drift
from mouse_cli.updating.recordings.fit import Fit
from mouse_cli.updating.recordings.misread import misread
from mouse_cli.updating.recordings.mistakes import check
from mouse_cli.updating.recordings.noise import doubtful, noise
from mouse_cli.updating.recordings.positional import positional
from mouse_cli.updating.recordings.pushed import pushed
from mouse_cli.updating.recordings.regression import Regression, Start, starts
from mouse_cli.updating.recordings.saturated import saturated
from mouse_cli.updating.recordings.study import Study, fitted
from mouse_cli.updating.recordings.tone import tone
from mouse_cli.updating.refusals import not_simulated

_MORE, _NEAREST = 12, 3  # starts that are fitted where none of the first is adequate; laws begun again with nuisances at their mean
# Of what is missing: error of first looks, where nuisances that leave their prior explain it by first order
_FIRST_ORDER = 0.02
_TAKEN = 0.5  # of what may be noise, that a law leaves at most to be more than it
_SERIES = "smooth-stiffness"  # group of laws that are terms of one power series
_ABOUT = 1.15  # times the least that a law leaves, up to which another one leaves about as much
_ROUNDS, _SECONDS = 3, 4  # laws beside which a second one is sought, and starts of it that are fitted

Notice = Callable[[str], None]


@dataclass(frozen=True)
class Weighed:
    """The model as it is, and every explanation that was followed to its optimum.

    noise: what is left beside the explanation `beside`, where that is more than the accuracy of the channels and yet noise.
    dropped: keys of laws that were fitted and that the records cannot show, with the reason; they are not among the fits.
    otherwise: what explains the records, though no law does: a sentence.
    """

    baseline: Fit
    fits: list[Fit]
    noise: Noise | None = None
    beside: Fit | None = None
    dropped: tuple[tuple[str, str], ...] = ()
    otherwise: str = ""


def weighed(study: Study, notice: Notice, known: list[Law] | None = None, causes: int = 2) -> Weighed:
    """The model as it is, then one law, then, where no single one is adequate and what it leaves is no noise, up to `causes`.

    Raises NumericalError (MD540) where the model as it is cannot be simulated, DeckError (MD457) for records that are misread.
    """
    notice("the linear model as it is")
    baseline = fitted(study, None)
    if baseline is not None and study.tune(baseline):
        baseline = fitted(study, Start(study.base, baseline.x, 0.0))
    if baseline is None:
        raise not_simulated(study.problem)
    if not missing(baseline):
        return Weighed(baseline, [])
    check(study)
    if (repeats := positional(study.spectrum, study.base, study.places)) is not None:
        return Weighed(baseline, [], otherwise=repeats.said())
    quiet = _left(study, baseline) if unlikely(baseline) else None
    noisy = _quietly(baseline, quiet)
    if noisy and not doubtful(study.spectrum, study.base, study.places, quiet):
        return Weighed(baseline, [], quiet, baseline)
    if said := disturbed(study, baseline):
        return Weighed(baseline, [], quiet, baseline if noisy else None, otherwise=said)
    if not noisy and (said := _beyond_laws(study)):
        return Weighed(baseline, [], otherwise=said)
    dropped: dict[str, str] = {}
    found = undamped(study, shown(study, _singles(study, notice, known, baseline), dropped), dropped)
    best = min([baseline, *found], key=innovation)
    if noisy and innovation(best) > _TAKEN * innovation(baseline):
        return Weighed(baseline, [], quiet, baseline)
    if best is baseline or adequate(best):
        return Weighed(baseline, found, dropped=tuple(dropped.items()))
    quiet = _left(study, best)
    if not _quietly(best, quiet) and causes > 1:
        found = undamped(study, found + shown(study, _pairs(study, notice, known, found), dropped), dropped)
        best = min(found, key=innovation)
        quiet = None if adequate(best) else _left(study, best)
    said = broken(study) or unmeasured(study, baseline) if innovation(best) > _TAKEN * innovation(baseline) else ""
    return Weighed(baseline, found, quiet, None if quiet is None else best, tuple(dropped.items()), said)


def _beyond_laws(study: Study) -> str:
    """What explains the records and is no law of a motion: a tone, a change, a drift, a channel that saturates; empty: none."""
    steady = lambda study: tone(study.spectrum, study.base, study.places)
    looks = steady, changed, drift, saturated
    return next((found.said() for look in looks if (found := look(study)) is not None), "")


def _left(study: Study, one: Fit) -> Noise | None:
    if odd(one, study.data) is not None:
        return None
    return noise(study.spectrum, one.hypothesis, study.places, one.x)


def _quietly(one: Fit, quiet: Noise | None) -> bool:
    """Whether a fit leaves noise with parameters where their prior allows them: what strains these asks for something more."""
    return quiet is not None and not strained(one, with_noise(one, quiet))


def _singles(study: Study, notice: Notice, known: list[Law] | None, baseline: Fit) -> list[Fit]:
    notice(f"{len(study.places)} sites, first pass")
    error = _FIRST_ORDER if strained(baseline) else 0.0
    order = pushed(baseline, study.places, _of_places(known))
    order += _looked(study, lambda place: study.looked(place, study.spectrum, error=error), known)
    found, best, tried, order = [], baseline, [], varied(order)
    for count, start in enumerate(order, 1):
        if count > POLISHED and (adequate(best) or count > _MORE):
            break
        notice(_named(start))
        tried.append(start)
        one = fitted(study, start, best.cost if found else np.inf)
        if one is not None:
            found.append(one)
            best = min(best, one, key=innovation)
    if not adequate(best):
        found += _again(study, found, order, tried)
    elif best is not baseline:
        for start in alike(order, tried, where(best)):
            notice(_named(start))
            one = fitted(study, start, best.cost)
            found += [] if one is None else [one]
    return found + _relatives(study, best, known)


def _looked(study: Study, look: Callable[[Place], Regression], known: list[Law] | None) -> list[Start]:
    """Every law at every place, and every error of a channel, that which leaves least first."""
    keys = None if known is None else {law.key for law in known}
    errors = [one for key, one in misreadings(study.look.dt).items() if keys is None or key in keys]
    every = starts((look(place) for place in study.places), _of_places(known))
    if errors and study.channels:
        every += misread(look(study.places[0]), study.channels, errors)
    return sorted(every, key=lambda one: one.left)


def _of_places(known: list[Law] | None) -> list[Law] | None:
    """Those of `known` that act at places of the structure, and not on a channel."""
    return None if known is None else [law for law in known if not isinstance(law, Misreading)]


def _named(start: Start) -> str:
    return " and ".join(f"{part.law.title}, {part.site.text}" for part in start.hypothesis.parts)


def _pairs(study: Study, notice: Notice, known: list[Law] | None, singles: list[Fit]) -> list[Fit]:
    """Two laws: a second one beside the best, then beside that second one by itself, as the first may have stood for both."""
    found: list[Fit] = []
    first = plainest(singles)
    tried = []
    for _ in range(_ROUNDS):
        tried.append(where(first))
        notice(f"a second law beside {first.hypothesis.law.title}, {first.hypothesis.parts[0].site.text}")
        found += _beside(study, notice, known, first, found)
        if not found:
            break
        if adequate(best := min(found, key=innovation)):
            return found + _one_less(study, best)
        first = _other(study, min(found, key=innovation), tried)
        if first is None:
            break
    return found


def _one_less(study: Study, pair: Fit) -> list[Fit]:
    """A pair without its second law, begun where it ended: what a first search could not leave may be left beside another law."""
    count = len(pair.hypothesis.parts[-1].unknowns)
    first = pair.hypothesis.without_last.placed(pair.hypothesis.parts[0].place)
    one = fitted(study, Start(first, pair.x[:-count], 0.0))
    return [] if one is None else [one]


def plainest(singles: list[Fit]) -> Fit:
    """The law with the fewest sizes among those that leave about the least: further sizes follow what the second law will take."""
    least = _ABOUT * min(map(innovation, singles))
    return min(
        (one for one in singles if innovation(one) <= least),
        key=lambda one: (len(one.hypothesis.unknowns), innovation(one)),
    )


def _beside(study: Study, notice: Notice, known: list[Law] | None, first: Fit, others: list[Fit]) -> list[Fit]:
    """Fits of `first` with a second law; two laws of one group at one place are one."""
    order = pushed(first, study.places, _of_places(known))
    order += _looked(study, lambda place: study.looked(place, study.spectrum, first), known)
    order = [one for one in varied(order) if not doubled(one)]
    found: list[Fit] = []
    for start in order[:_SECONDS]:
        notice(_named(start))
        best = min([*others, *found], key=innovation, default=None)
        one = fitted(study, start, np.inf if best is None else best.cost, first)
        found += [] if one is None else [one]
    return found


def doubled(start: Start) -> bool:
    """Whether two of its laws are of one group at one place, one law in two manners, whose shares no record tells, but for terms of
    smooth stiffness, which add up; amount to a third one there; or are linear, one of them such as acts alone.
    """
    parts = start.hypothesis.parts
    laws = [(part.law.key if part.law.group == _SERIES else part.law.group, part.place.where) for part in parts]
    there = {(part.law.key, part.variant, part.place.where) for part in parts}
    amounts = any((key, i, part.place.where) in there for part in parts for key, i, _ in part.law.amounts)
    alone = any(part.law.solitary for part in parts) and sum(part.law.linear for part in parts) > 1
    return amounts or alone or len({*laws}) < len(laws)


def _other(study: Study, pair: Fit, tried: list[tuple[str, str]]) -> Fit | None:
    """The second law of a pair by itself; None where it was a first already."""
    part, hypothesis = pair.hypothesis.parts[-1], pair.hypothesis
    count = len(part.unknowns)
    alone = study.base.placed(part.place).at(part.law, part.variant)
    x = np.concatenate([pair.x[: hypothesis.nuisances], pair.x[-count:]])
    if (part.law.key, part.place.where) in tried:
        return None
    return fitted(study, Start(alone, x, 0.0))


def _again(study: Study, singles: list[Fit], order: list[Start], tried: list[Start]) -> list[Fit]:
    """The laws that come nearest with nuisances at their mean, then harder stops, other laws at their places, each of them at other
    places, and the nearest from other sizes, until the best is adequate.

    What a first look put far from the prior may have been given up behind a law that is not the true one; the true law may be
    behind those of its group that are like it, and the true place behind others, where nuisances help.
    """
    near = {where(one): one for one in sorted(singles, key=innovation, reverse=True)}
    nearest, found = sorted(near.values(), key=innovation)[:_NEAREST], []

    def turns() -> Iterator[list[tuple[Start, float]]]:
        yield from ([(from_mean(one), np.inf)] for one in nearest)
        yield [(start, np.inf) for start in harder(order)]
        for place in dict.fromkeys(where(one)[1] for one in nearest):
            yield [(start, np.inf) for start in others_there(order, tried, place)]
        for law in dict.fromkeys(one.hypothesis.law.key for one in nearest):
            yield [(start, np.inf) for start in elsewhere(order, tried, law)]
        if nearest:
            yield from ([each] for each in begun_again(study, min([*nearest, *found], key=innovation)))

    for turn in turns():
        for start, beat in turn:
            one = fitted(study, start, beat)
            found += [] if one is None else [one]
        if adequate(min([*nearest, *found], key=innovation)):
            break
    return found


def _relatives(study: Study, best: Fit, known: list[Law] | None) -> list[Fit]:
    """Laws begun from one that comes nearest and does not do: Iwan's from friction, and those of its group with the same sizes."""
    law = best.hypothesis.law
    if law is None or adequate(best):
        return []
    bare, count = best.hypothesis.without_last, len(best.hypothesis.parts[-1].unknowns)
    nuisances, sizes = best.x[:-count], np.exp(best.x[-count:])
    begun = [(one, i, sizes, nuisances) for one in laws().values() if _sibling(one, law) for i in range(len(one.variants))]
    if law.key == "friction":
        kt, slip = sizes
        begun.append((laws()["iwan"], 0, np.array([1.3 * slip, 1.3 * kt, 0.6, 1.0]), nuisances))
    if best.hypothesis.parts[-1].place.scale.link:  # a slider in a spring of the model, or beside it
        begun += [(laws()[other], 0, sizes, np.zeros_like(nuisances)) for *_, other in law.amounts]
    found = []
    for one, variant, p, z in begun:
        if known is None or one in known:
            fit = fitted(study, Start(bare.at(one, variant), np.concatenate([z, np.log(p)]), 0.0))
            found += [] if fit is None else [fit]
    return found


def _sibling(one: Law, law: Law) -> bool:
    """Whether two laws of one group have the same sizes, so that a first look easily takes one for the other."""
    names = lambda each: [(size.name, size.unit) for size in each.parameters]
    return one is not law and one.group == law.group and names(one) == names(law)
