"""Several mechanisms together, as many as the data need: one is added, each is exchanged in turn, and none stays needlessly.

Pairs begin from every leading single one. Larger sets grow from the best smaller ones, and from several of one kind: masses removed
at three places look like anything but one of them.
"""

from collections.abc import Iterable

import numpy as np

from mouse_cli.diagnosis.gates import GATE, MATERIAL
from mouse_cli.diagnosis.search.descents import settled, summed
from mouse_cli.diagnosis.search.escape import shifted, tied, walked
from mouse_cli.diagnosis.search.fit import MOST, Fit, fit
from mouse_cli.diagnosis.search.found import Found, best_of, keep, key, material, replaced
from mouse_cli.diagnosis.search.optima import NEAR, within
from mouse_cli.diagnosis.search.pared import pared
from mouse_cli.diagnosis.search.parts import Beside, in_turn, look_beside, partner
from mouse_cli.diagnosis.search.study import Study
from mouse_cli.diagnosis.validate.held_out import held_out_density
from mouse_cli.updating.chi_square import upper_tail

_SECOND, _QUICK = 2, 8  # fits of a further mechanism beside others, and their steps, in a first try
_SWAPPED, _FINISHED = 4, 6  # pairs whose aliases are tried; sets that are fitted to the end
_PAIRED, _WIDE = 8, 5  # candidates that are tried in pairs; groups of which the best is tried with every candidate
_TOGETHER = 16  # pairs that are begun where effects add up best
_PARTNERS = 6  # candidates that a first look finds best beside others, which alone are fitted
_GROWN, _ALIKE = 2, 5  # sets that grow further; kinds of which several are tried
_ROUNDS = 3  # of exchanges
_FAR = 100.0  # as FAR, of sets: many are tried, and brief descents say enough of them
_LIMITS = (  # groups of which one is the other at an end of its range: a crack at a clamp, an item on a stiff or a soft mount
    {"local-stiffness", "support"},
    {"mass", "oscillator"},
    {"ground-spring", "oscillator"},
)
_EXCHANGED = 3  # sets whose mechanisms are exchanged to see what is as good
_REACH = 6.0  # log evidence below that of the best from which on a set that is fitted in few steps is no rival of it
_ADEQUATE = 0.05  # p-value of the misfit below which a further mechanism is sought


def plain(found: Iterable[Fit]) -> list[Fit]:
    """Those of one size at one place, of what leads with several parts the best that has one."""
    alone = [[each for each in (one, *(other for other, _ in one.elsewhere)) if len(key(each)) == 1] for one in found]
    return [max(own, key=lambda each: each.log_evidence) for own in alone if own]


def adequate(one: Fit, least: float = _ADEQUATE) -> bool:
    """Whether what a fit leaves may be noise."""
    return upper_tail(one.misfit, max(one.dof, 1)) > least


def enough(one: Fit, least: float = _ADEQUATE, held: float = _ADEQUATE) -> bool:
    """Whether what a fit leaves may be noise: p above `least` of what was fitted, and above `held` of what the deck holds out."""
    return adequate(one, least) and ((rest := held_out_density(one)) is None or rest.p > held)


def several(study: Study, singles: list[Fit], most: int, trusted: bool = True) -> list[Fit]:
    """Sets of two mechanisms, and of more up to `most` as long as every set leaves more than noise, and the best gains.

    Where one alone is not refuted (GATE), by what the deck holds out neither, sets are sought only beside those that come near it,
    and further if one of them gains.
    trusted: whether what one alone leaves says that the test is as accurate as stated; else a pair that leaves no more has to.
    """
    alone = plain(singles)
    if any(enough(one, GATE, GATE) for one in alone) and not _gains(
        study, [one for one in alone if one.misfit <= within(alone)]
    ):
        return []
    singles = singles + [one for one in alone if not any(one is other for other in singles)]
    found = pairs(study, singles)
    smaller, growing = singles + found, found
    most = most if trusted or any(map(adequate, found)) else min(most, 2)
    of_kind = (trusted and most > 2) or not any(map(enough, found))
    alike = same_kind(study, singles, most, within(smaller)) if of_kind else []
    count = 3
    while count <= most and not any(map(enough, growing)):
        begun = sorted(growing, key=lambda one: -one.log_evidence)[:_GROWN]
        larger = Found()
        for one in begun:
            _beside(study, one, study.known, larger)
        for best in best_of(larger, 1):
            keep(larger, _exchanged(study, best))
        for best in best_of(larger, 1):
            _swap(study, best, larger)
        finished = _finished(study, larger)
        fewer = _fewer(study, finished, smaller)
        found, smaller = replaced(found, fewer), replaced(smaller, fewer)
        growing = [one for one in finished if material(one, smaller)]
        if not growing:
            break
        found, smaller, count = found + growing, smaller + growing, count + 1
    known = {key(one) for one in found}
    found += [one for one in alike if key(one) not in known and material(one, smaller + alike)]
    return replaced(found, _as_good(study, found, smaller))


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
        for rest in (_without(left[0], i) for i in range(len(left[0].recipes))):
            if rest is not None:
                _beside(study, rest, study.known, tried)
        least = best.log_evidence - _REACH
        better = lambda name, one: name not in known or one.log_evidence > known[name].log_evidence + 1.0
        near = {name: one for name, one in tried.items() if one.log_evidence > least and better(name, one)}
        for one in _finished(study, near):
            keep(known, one), keep(more, one)
    return [one for one in more.values() if material(one, smaller)]


def _gains(study: Study, singles: list[Fit]) -> bool:
    """Whether a further mechanism beside one of `singles` gains what it must, those fitted to the end that gain in few steps."""
    least = max(one.log_evidence for one in singles)
    for first in sorted(singles, key=lambda one: -one.log_evidence)[:_WIDE]:
        found = Found()
        _beside(study, first, study.known, found)
        better = {name: two for name, two in found.items() if two.log_evidence > least}
        if any(material(two, singles) for two in _finished(study, better)):
            return True
    return False


def pairs(study: Study, singles: list[Fit]) -> list[Fit]:
    """Two: the leading ones of different groups with the best partners, the leading ones with one another, and aliases.

    All are tried in few steps; those that lead are fitted to the end.
    """
    leading = sorted(singles, key=lambda one: -one.log_evidence)[:_PAIRED]
    firsts = {
        (one.recipes[0].candidate.group, len(key(one)) > 1): one for one in reversed(leading)
    }  # the best of each group
    wide = sorted(firsts.values(), key=lambda one: -one.log_evidence)[:_WIDE]
    found, names = Found(), [one.recipes[0].candidate.key for one in leading]
    for first in leading:
        any_of = any(first is one for one in wide)
        _beside(study, first, study.known if any_of else names, found)
    for recipes, c in study.coarse.together(names, _TOGETHER):  # either alone may be nowhere near its place
        model = study.kind(study.model, study.own(recipes))
        keep(found, fit(model, c, np.zeros(study.k), _QUICK, within([*singles, *found.values()], _FAR)))
    done: list[Fit] = []
    for _ in range(_ROUNDS):  # both may be there by an alias, or at a wrong site
        for two in best_of(found, _SWAPPED):
            if not any(two is one for one in done):
                done.append(two)
                _swap(study, two, found)
    for two in best_of(found, 1):  # the mechanism that leads with a partner may be none of those that lead alone
        keep(found, _exchanged(study, two))
    return [two for two in _finished(study, found) if material(two, singles)]


def same_kind(study: Study, singles: list[Fit], most: int, reach: float = np.inf) -> list[Fit]:
    """Two and more of one kind at different sites, each moved in turn to where it fits best; reach: misfit that matters."""
    found = Found()
    order = sorted(singles, key=lambda one: -one.log_evidence)
    kinds = [one for one in order if len(study.recipes(one.recipes[0].candidate.key)) > 1 and one.c.size][:_ALIKE]
    for one in kinds:
        if not _grown(study, one, most, found, reach) and not adequate(one):
            for other in _elsewhere(study, one):  # beside all feet of a frame no foot of it can be flexible once more
                _grown(study, other, most, found, reach)
    return _finished(study, found)


def _grown(study: Study, one: Fit, most: int, found: Found, reach: float) -> bool:
    """Into `found` sets of the kind of `one` that grow from it; whether there are any."""
    name, grew = one.recipes[0].candidate.key, False
    while len(one.recipes) < most and not adequate(one):
        larger = Found()
        _beside(study, one, [name], larger)
        if not any(_promised(one, each, most) < reach for each in larger.values()):
            break
        more = [_exchanged(study, each, (name,)) for each in larger.values()]
        if not more or more[0].log_evidence < one.log_evidence + MATERIAL:
            break
        one, grew = more[0], True
        keep(found, one)
    return grew


def _promised(one: Fit, larger: Fit, most: int) -> float:
    """The misfit if every further one up to `most`, and every exchange, gained as the last one did."""
    return larger.misfit * min(1.0, larger.misfit / one.misfit) ** (2 * (most - len(one.recipes)))


def _elsewhere(study: Study, one: Fit) -> list[Fit]:
    """The same kind in the recipes that are next best by themselves, in few steps."""
    (recipe,) = one.recipes
    name, fits = recipe.candidate.key, {}
    for _, number, x in study.looks(name, np.zeros(study.k), ()):
        if number != recipe.number and number not in fits and len(fits) < _SECOND:
            fits[number] = fit(study.with_cause((), name, number), x[study.k :], x[: study.k], _QUICK)
    return [each for each in fits.values() if each is not None]


def _fewer(study: Study, sets: list[Fit], smaller: list[Fit]) -> list[Fit]:
    """What is left of the best of `sets` without one of its mechanisms, wherever that is more probable than all of its kind before.

    What was added last may have brought the others to where they do without one that came earlier.
    """
    parts = Found()
    for best in sorted(sets, key=lambda one: -one.log_evidence)[:1]:
        for i in range(len(best.recipes)):
            keep(parts, _without(best, i, MOST, within([best])))
    before = {key(one): one.log_evidence for one in sorted(smaller, key=lambda one: one.log_evidence)}
    better = {name: one for name, one in parts.items() if one.log_evidence > before.get(name, -np.inf) + 1.0}
    return [one for one in _finished(study, better) if material(one, smaller)]


def _finished(study: Study, found: Found) -> list[Fit]:
    """The best fitted to the end, their evidence summed over sites that are as good."""
    ended = [settled(walked(shifted(pared(one, study)), study), study) for one in best_of(found, _FINISHED)]
    return [summed([one, *tied(one, study)]) for one in ended]


def _swap(study: Study, one: Fit, found: Found) -> None:
    """Into `found` the same mechanisms with each replaced by what is hard to tell from it, begun from the set itself.

    Where the set leaves too much that may be the same mechanism at another site.
    """
    for i, recipe in enumerate(one.recipes):
        own, moved = recipe.candidate, not adequate(one)
        alike = {own.group}.union(*(pair for pair in _LIMITS if own.group in pair))
        aliases = [name for name, each in study.known.items() if each.group in alike and (moved or name != own.key)]
        rest = _without(one, i)
        if rest is not None and aliases:
            _beside(study, rest, aliases, found)


def _beside(study: Study, first: Fit, partners: Iterable[str], found: Found) -> None:
    """Into `found` what `first` and the best of `partners` make together, where it is better than what is there."""
    there = study.about(first)
    names = found.untried(first, _promising(study, there, first, list(partners)))
    beside, own = Beside.of(first, there), there.own(first.recipes)

    def reach(i: int) -> float:
        same = found.get(tuple(sorted((*key(first), names[i]))))
        return min(within([first, *found.values()], _FAR), np.inf if same is None else within([same], NEAR))

    def accept(i: int, fits: list) -> None:
        for one in fits:
            keep(found, one.fit(there, own, names[i]))

    in_turn(study, partner, [(beside, name, _SECOND, _QUICK) for name in names], accept, reach)


def _promising(study: Study, there: Study, first: Fit, partners: list[str]) -> list[str]:
    """Those of `partners` that a first look beside `first` finds best."""
    if len(partners) <= _PARTNERS:
        return partners
    coarse, beside, looks = there.coarse, Beside.of(first, there), {}

    def accept(i: int, seen: list) -> None:
        looks[partners[i]] = seen
        coarse.keep_beside(partners[i], first.point.x, first.recipes, seen)

    in_turn(study, look_beside, [(beside, name) for name in partners], accept)
    order = sorted((name for name in partners if looks[name]), key=lambda name: looks[name][0][0])
    return order[:_PARTNERS]


def _exchanged(study: Study, one: Fit, names: tuple[str, ...] | None = None) -> Fit:
    """The set with each mechanism in turn replaced by what fits best beside the others, while that gains and it leaves too much.

    names: candidates that may take a place; None: all.
    """
    for _ in range(_ROUNDS if not adequate(one) else 0):
        before = one.log_evidence
        for i in range(len(one.recipes)):
            rest = _without(one, i)
            if rest is None:
                continue
            found = Found()
            _beside(study, rest, study.known if names is None else names, found)
            better = max(found.values(), key=lambda each: each.log_evidence, default=one)
            one = better if better.log_evidence > one.log_evidence else one
        if one.log_evidence < before + 1.0:
            break
    return one


def _without(one: Fit, i: int, most: int = 0, reach: float = np.inf) -> Fit | None:
    """The fit without its mechanism number i, in at most so many steps: with none the others and the parameters are as they are,
    for begun anew they would make up for it. reach: as `fit` has it.
    """
    rest = (*one.recipes[:i], *one.recipes[i + 1 :])
    c = np.concatenate([np.zeros(0), *(one.c[own] for j, own in enumerate(one.model.own) if j != i)])
    return fit(type(one.model)(one.model.base, rest), c, one.point.x[: one.model.k], most, reach)
