"""Several mechanisms together, as many as the data need: one is added, each is exchanged in turn, and none stays needlessly.

Pairs begin from every leading single one. Larger sets grow from the best smaller ones, and from several of one kind: masses removed
at three places look like anything but one of them.
"""

from collections.abc import Iterable

import numpy as np

from mouse_cli.diagnosis.gates import GATE, SEVERAL
from mouse_cli.diagnosis.search.alike import same_kind
from mouse_cli.diagnosis.search.fit import MOST, Fit
from mouse_cli.diagnosis.search.found import Found, best_of, keep, key, material, replaced
from mouse_cli.diagnosis.search.moves import (
    ADEQUATE,
    FAR_OF_SETS,
    REACH,
    added_up,
    adequate,
    any_explains,
    beside,
    centred,
    exchanged,
    finished,
    promised,
    swap,
    without,
)
from mouse_cli.diagnosis.search.optima import within
from mouse_cli.diagnosis.search.study import Study
from mouse_cli.diagnosis.validate.held_out import held_out_density

FURTHER = 0.2  # p-value of the best set below which a larger one may gain what its prior takes, some ten nats
_BEHIND = 25.0  # times the misfit of the best alone, from which on none begins a pair beside one that explains the data
_SWAPPED = 4  # pairs whose aliases are tried
_PAIRED, _WIDE = 8, 5  # candidates that are tried in pairs; groups of which the best is tried with every candidate
_NATS = 30.0  # by which two are more probable than one, whatever the noise, for a third to be sought beside what may be noise
_ROUNDS = 3  # of aliases
_GROWN = 2  # sets that grow further
_EXCHANGED = 3  # sets whose mechanisms are exchanged to see what is as good


def plain(found: Iterable[Fit]) -> list[Fit]:
    """Those of one size at one place, of what leads with several parts the best that has one."""
    alone = [[each for each in (one, *(other for other, _ in one.elsewhere)) if len(key(each)) == 1] for one in found]
    return [max(own, key=lambda each: each.log_evidence) for own in alone if own]


def enough(one: Fit, least: float = ADEQUATE, held: float = SEVERAL) -> bool:
    """Whether what a fit leaves may be noise: p above `least` of what was fitted, and above `held` of what the deck holds out."""
    return adequate(one, least) and ((rest := held_out_density(one)) is None or rest.p > held)


def several(study: Study, singles: list[Fit], most: int, trusted: bool = True, begun: Found | None = None) -> list[Fit]:
    """Sets of two mechanisms, and of more up to `most` as long as every set leaves more than noise, and the best gains.

    Where one alone is not refuted (GATE), by what the deck holds out neither, sets are sought only beside those that come near it,
    and further if one of them gains.
    trusted: whether what one alone leaves says that the test is as accurate as stated; else a pair has to, or gains what no noise
    would give it. begun: see `alone`.
    """
    alone = plain(singles)
    if any(enough(one, GATE, GATE) for one in alone) and not _gains(
        study, [one for one in alone if one.misfit <= within(alone)]
    ):
        return []
    singles = singles + [one for one in alone if not any(one is other for other in singles)]
    found = pairs(study, singles, begun := Found(begun))
    smaller, growing = singles + found, found
    most = most if trusted or any(map(adequate, found)) or _demanded(alone, found) else min(most, 2)
    of_kind = (trusted and most > 2) or not any(map(enough, found))
    alike = same_kind(study, singles, most, smaller, begun) if of_kind else []
    count, before = 3, alone
    explains = lambda one: len(one.recipes) <= count and enough(one, FURTHER)
    while count <= most and not any(map(explains, growing + alike)) and hopeful(before, [*growing, *begun.values()], most):
        larger = _of(begun, count)
        added_up(study, count, larger, growing)
        for one in _begun(growing):
            beside(study, one, study.known, larger)
        for best in best_of(larger, 1):
            keep(larger, exchanged(study, best, least=FURTHER))
        for best in best_of(larger, 1):
            swap(study, best, larger)
        ended = finished(study, larger)
        fewer = _fewer(study, ended, smaller)
        found, smaller, before = replaced(found, fewer), replaced(smaller, fewer), growing
        growing = [one for one in ended if material(one, smaller)]
        if not growing:
            break
        found, smaller, count = found + growing, smaller + growing, count + 1
    known = {key(one) for one in found}
    found += [one for one in alike if key(one) not in known and material(one, smaller + alike)]
    return replaced(found, _as_good(study, found, smaller) if _exchangeable(found, smaller) else [])


def _demanded(singles: list[Fit], sets: list[Fit]) -> bool:
    """Whether the best of `sets` is more probable than the best single one however inaccurate the test is: of two mechanisms that
    are there without a third one, as of noise that is more than stated, much is left.
    """
    if not singles or not sets:
        return False
    one, best = (min(each, key=lambda fit: fit.misfit) for each in (singles, sets))
    return best.dof / 2 * np.log(one.misfit / best.misfit) > _NATS


def hopeful(fewer: list[Fit], sets: list[Fit], most: int) -> bool:
    """Whether sets of `most` may explain the data if each further mechanism gained twice what the last one did, in ln of misfit.

    fewer: sets of one mechanism less. Of what no name explains the largest set leaves far more than noise, after most of the work.
    """
    if not fewer or not sets:
        return False
    best, before = (min(each, key=lambda one: one.misfit) for each in (sets, fewer))
    return promised(before, best, most - len(best.recipes)) <= best.bearable * max(best.dof, 1)


def _begun(sets: list[Fit]) -> list[Fit]:
    """Those of `sets` that grow: the best, and the best of those with fewer unknowns, for an arm may do what a third one does."""
    order = sorted(sets, key=lambda one: -one.log_evidence)
    best, fewest = order[:_GROWN], min((one.c.size for one in order[:_GROWN]), default=0)
    return best + [one for one in order[_GROWN:] if one.c.size < fewest][:1]


def _exchangeable(found: list[Fit], smaller: list[Fit]) -> bool:
    """Whether exchanges may make sets of `found` explain the data: none does more than one further mechanism would."""
    largest = max((len(one.recipes) for one in found), default=0)
    fewer = [one for one in smaller if len(one.recipes) < largest]
    return any(map(enough, found)) or hopeful(fewer, found, largest + 1)


def _as_good(study: Study, found: list[Fit], smaller: list[Fit]) -> list[Fit]:
    """Sets that the data hardly tell from the best of `found`: each of its mechanisms replaced by whatever fits beside the others.

    Probabilities are shares among all that explain the data, so that those have to be known; one that is better is exchanged too.
    As long as the best leaves too much the next one is, for two of its mechanisms may stand for others that need one another.
    """
    known, more, done = Found(), Found(), []
    for one in found:
        keep(known, one)
    for _ in range(_EXCHANGED):
        order = best_of(known, len(known))
        left = [one for one in order if not any(one is each for each in done)]
        if not left or (left[0] is not order[0] and adequate(order[0])):
            break
        best, tried = order[0], Found()
        done.append(left[0])
        for rest in (without(left[0], i) for i in range(len(left[0].recipes))):
            if rest is not None:
                beside(study, rest, study.known, tried)
        least = best.log_evidence - REACH
        better = lambda name, one: name not in known or one.log_evidence > known[name].log_evidence + 1.0
        near = {name: one for name, one in tried.items() if one.log_evidence > least and better(name, one)}
        for one in finished(study, near):
            keep(known, one), keep(more, one)
    return [one for one in more.values() if material(one, smaller)]


def _gains(study: Study, singles: list[Fit]) -> bool:
    """Whether a further mechanism beside one of `singles` gains what it must, those fitted to the end that gain in few steps."""
    least = max(one.log_evidence for one in singles)
    for first in sorted(singles, key=lambda one: -one.log_evidence)[:_WIDE]:
        found = Found()
        beside(study, first, study.known, found)
        better = {name: two for name, two in found.items() if two.log_evidence > least}
        if any(material(two, singles) for two in finished(study, better)):
            return True
    return False


def pairs(study: Study, singles: list[Fit], begun: Found | None = None) -> list[Fit]:
    """Two: the leading ones of different groups with the best partners, the leading ones with one another, and aliases.

    All are tried in few steps; those that lead are fitted to the end. begun: sets of any size, beside which they have to matter.
    """
    leading = sorted(singles, key=lambda one: -one.log_evidence)[:_PAIRED]
    firsts = {
        (one.recipes[0].candidate.group, len(key(one)) > 1): one for one in reversed(leading)
    }  # the best of each group
    wide = sorted(firsts.values(), key=lambda one: -one.log_evidence)[:_WIDE]
    names = [one.recipes[0].candidate.key for one in leading]
    found = Found(begun)
    if not found:
        added_up(study, 2, found, singles)
    explained = lambda: any_explains(_of(found, 2), GATE)
    if not explained():
        centred(study, leading[0])
    least = min(one.misfit for one in leading)
    for first in leading:
        if first.misfit > _BEHIND * least and explained():
            continue
        any_of = any(first is one for one in wide)
        beside(study, first, study.known if any_of else names, found)
    done: list[Fit] = []
    for _ in range(_ROUNDS):  # both may be there by an alias, or at a wrong site
        for two in best_of(_of(found, 2, near=True), _SWAPPED):
            if not any(two is one for one in done):
                done.append(two)
                swap(study, two, found)
    for two in best_of(_of(found, 2, near=True), 1):  # what leads with a partner may be none of those that lead alone
        keep(found, exchanged(study, two))
    return [two for two in finished(study, _of(found, 2)) if material(two, singles)]


def _of(found: Found, count: int, near: bool = False) -> Found:
    """Those of `count` mechanisms; near: that may rival the best of all."""
    reach = within(found.values(), FAR_OF_SETS) if near else np.inf
    return Found({name: one for name, one in found.items() if len(one.recipes) == count and one.misfit <= reach})


def _fewer(study: Study, sets: list[Fit], smaller: list[Fit]) -> list[Fit]:
    """What is left of the best of `sets` without one of its mechanisms, wherever that is more probable than all of its kind before.

    What was added last may have brought the others to where they do without one that came earlier.
    """
    parts = Found()
    for best in sorted(sets, key=lambda one: -one.log_evidence)[:1]:
        for i in range(len(best.recipes)):
            keep(parts, without(best, i, MOST, within([best])))
    before = {key(one): one.log_evidence for one in sorted(smaller, key=lambda one: one.log_evidence)}
    better = {name: one for name, one in parts.items() if one.log_evidence > before.get(name, -np.inf) + 1.0}
    return [one for one in finished(study, better) if material(one, smaller)]
