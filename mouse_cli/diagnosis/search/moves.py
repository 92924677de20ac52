"""What is done to a set of mechanisms: one more is put beside it, one is taken out or exchanged, and it is fitted to the end."""

from collections.abc import Iterable, Mapping

import numpy as np

from mouse_cli.diagnosis.effects.change import Recipe
from mouse_cli.diagnosis.search.descents import idealised, plainer, settled, summed
from mouse_cli.diagnosis.search.escape import shifted, tied, walked
from mouse_cli.diagnosis.search.fit import Fit, fit
from mouse_cli.diagnosis.search.found import Found, best_of, keep, key
from mouse_cli.diagnosis.search.optima import NEAR, within
from mouse_cli.diagnosis.search.pared import pared
from mouse_cli.diagnosis.search.parts import Beside, centre, in_turn, learn_beside, look_beside, partner
from mouse_cli.diagnosis.search.study import Study
from mouse_cli.diagnosis.search.superposed import text
from mouse_cli.updating.chi_square import upper_tail

SECOND, QUICK = 2, 8  # fits of a further mechanism beside others, and their steps, in a first try
FAR_OF_SETS = 100.0  # as FAR, of sets: many are tried, and brief descents say enough of them
REACH = 6.0  # log evidence below that of the best from which on a set that is fitted in few steps is no rival of it
ADEQUATE = 0.05  # p-value of the misfit below which what is left is no noise
_SHARES = (0.15, 0.4, 0.65)  # of the sizes of a list, from which on sets are begun
_NEARLY = 5.0  # times the degrees of freedom: a misfit up to which other errors of theory may make it noise
_LESS = 2.0  # times the misfit that a mechanism promises, from which on another that promises more is no alias of it
_LOOKED = 16  # candidates that promise most beside others, which alone are looked at
_PARTNERS = 6  # of these those that a first look finds best, which alone are fitted
_FINISHED = 6  # sets that are fitted to the end
_ROUNDS = 3  # of exchanges
_TOGETHER = 16  # sets that are begun where effects add up best
_LIMITS = (  # groups of which one is the other at an end of its range: a crack at a clamp, an item on a stiff or a soft mount
    {"local-stiffness", "support"},
    {"mass", "oscillator"},
    {"ground-spring", "oscillator"},
)


def adequate(one: Fit, least: float = ADEQUATE) -> bool:
    """Whether what a fit leaves may be noise."""
    return upper_tail(one.misfit, max(one.dof, 1)) > least


def explained(one: Fit, least: float = ADEQUATE) -> bool:
    """The same by what theory errs with the mechanisms in it, where several arrangements share that."""
    if adequate(one, least):
        return True
    near = one.errs_alike and one.misfit < _NEARLY * max(one.dof, 1)
    return near and adequate(idealised(one), least)


def any_explains(found: Found, least: float) -> bool:
    """Whether one of those is adequate, or the best is by what theory errs with it."""
    return any(adequate(one, least) for one in found.values()) or any(explained(one, least) for one in best_of(found, 1))


def promised(before: Fit, after: Fit, steps: float) -> float:
    """The misfit after so many further mechanisms if each gained twice, in ln of the misfit, what `after` did on `before`."""
    return after.misfit * min(1.0, after.misfit / max(before.misfit, 1e-300)) ** (2 * steps)


def finished(study: Study, found: Mapping[tuple[str, ...], Fit]) -> list[Fit]:
    """The best fitted to the end, their evidence summed over sites that are as good."""
    ended = [settled(walked(shifted(pared(one, study)), study), study) for one in best_of(found, _FINISHED)]
    return [plainer(summed([one, *tied(one, study)]), study) for one in ended]


def added_up(study: Study, count: int, found: Found, smaller: list[Fit], kind: str = "", most: int = _TOGETHER) -> None:
    """Into `found` the `most` sets of `count` mechanisms whose effects add up best, all of candidate `kind` if it is given: each
    alone may be nowhere near its place.
    """
    for recipes, c in together(study.coarse, count, most, kind):
        model = study.kind(study.model, study.own(recipes))
        keep(found, fit(model, c, np.zeros(study.k), QUICK, within([*smaller, *found.values()], FAR_OF_SETS)))


def together(study: Study, count: int, most: int, kind: str = "") -> list[tuple[tuple[Recipe, ...], np.ndarray]]:
    """Those sets and their coordinates, in a study that has looked at all candidates by themselves."""
    made = []
    for _, members, _ in study.effects.sets(count, kind)[:most]:
        recipes = [next(each for each in study.recipes(name) if text(each) == place) for name, (place, _) in members]
        starts = [recipe.coordinates(recipe.grid[i]) for recipe, (_, (_, i)) in zip(recipes, members, strict=True)]
        made.append((tuple(recipes), np.concatenate(starts)))
    return made


def renamed(study: Study, one: Fit, name: str) -> Fit | None:
    """Candidate `name` in the place of every mechanism of a set, with as many sizes as it may have; None: it has no such site.

    Exchanged one by one, none of them may be better beside what the others still are.
    """
    recipes = []
    for site in one.sites:
        own = [recipe for recipe in study.recipes(name) if recipe.site(recipe.grid[0]).ids == site.ids and len(recipe.parts) < 2]
        recipes += sorted(own, key=lambda recipe: -len(recipe.unknowns))[:1]
    if len(recipes) < len(one.recipes) or len(set(map(text, recipes))) < len(recipes):
        return None
    model, fits = study.kind(study.model, tuple(recipes)), []
    for share in _SHARES:
        starts = [recipe.coordinates(recipe.grid[int(share * len(recipe.grid))]) for recipe in recipes]
        fits.append(fit(model, np.concatenate(starts), np.zeros(study.k), reach=within([one], FAR_OF_SETS)))
    return min((each for each in fits if each is not None), key=lambda each: each.misfit, default=None)


def swap(study: Study, one: Fit, found: Found) -> None:
    """Into `found` the same mechanisms with each replaced by what is hard to tell from it, begun from the set itself.

    Where the set leaves too much that may be the same mechanism at another site.
    """
    moved = not explained(one)
    for i, recipe in enumerate(one.recipes):
        own = recipe.candidate
        alike = {own.group}.union(*(pair for pair in _LIMITS if own.group in pair))
        aliases = [name for name, each in study.known.items() if each.group in alike and (moved or name != own.key)]
        rest = without(one, i)
        if rest is not None and aliases:
            beside(study, rest, _as_promising(study, rest, own.key, aliases), found)


def _as_promising(study: Study, rest: Fit, name: str, aliases: list[str]) -> list[str]:
    """Those of `aliases` that promise beside `rest` not much less than candidate `name` does, where effects add up."""
    coarse = study.about(rest).coarse
    promise = {each: coarse.promise(each, rest.point.x, rest.recipes) for each in {name, *aliases}}
    return [each for each in aliases if not promise[each] > _LESS * max(promise[name], rest.dof)]


def beside(study: Study, first: Fit, partners: Iterable[str], found: Found) -> None:
    """Into `found` what `first` and the best of `partners` make together, where it is better than what is there."""
    there = study.about(first)
    able = [name for name in partners if study.recipes(name)]
    names = found.untried(first, _promising(study, there, first, able))
    causes, own = Beside.of(first, there), there.own(first.recipes)

    def reach(i: int) -> float:
        same = found.get(tuple(sorted((*key(first), names[i]))))
        return min(within([first, *found.values()], FAR_OF_SETS), np.inf if same is None else within([same], NEAR))

    def accept(i: int, fits: list) -> None:
        for one in fits:
            keep(found, one.fit(there, own, names[i]))

    in_turn(study, partner, [(causes, name, SECOND, QUICK) for name in names], accept, reach)


def centred(study: Study, first: Fit) -> None:
    """From here on effects add up beside a fit, if its mechanisms turn the modes so far that others act otherwise beside them."""
    there = study.about(first)
    if there.coarse.turned(first.point.x, first.recipes):
        causes = Beside.of(first, there)
        centre(study, causes)
        if study.pool is not None:
            study.pool.broadcast(centre, causes)


def _promising(study: Study, there: Study, first: Fit, partners: list[str]) -> list[str]:
    """Those of `partners` that a first look beside `first` finds best, of such as promise most where effects add up; of all beside
    a centre.
    """
    if len(partners) <= _PARTNERS:
        return partners
    coarse, causes, looks = there.coarse, Beside.of(first, there), {}
    if not coarse.centred(first.point.x, first.recipes):
        promise = {name: coarse.promise(name, first.point.x, first.recipes) for name in partners}
        partners = sorted(partners, key=promise.__getitem__)[:_LOOKED]

    def accept(i: int, seen: tuple) -> None:
        looks[partners[i]], alone = seen
        coarse.keep(partners[i], first.point.x, first.recipes, *seen)
        if alone is not None and study.pool is not None:
            study.pool.broadcast(learn_beside, causes, partners[i], *seen)

    in_turn(study, look_beside, [(causes, name) for name in partners], accept)
    order = sorted((name for name in partners if looks[name]), key=lambda name: looks[name][0][0])
    return order[:_PARTNERS]


def exchanged(study: Study, one: Fit, names: tuple[str, ...] | None = None, least: float = ADEQUATE) -> Fit:
    """The set with each mechanism in turn replaced by what fits best beside the others, while that gains and it leaves too much.

    names: candidates that may take a place; None: all. least: p-value of its misfit below which it does leave too much.
    """
    for _ in range(_ROUNDS if not explained(one, least) else 0):
        before = one.log_evidence
        for i in range(len(one.recipes)):
            rest = without(one, i)
            if rest is None:
                continue
            found = Found()
            beside(study, rest, study.known if names is None else names, found)
            better = max(found.values(), key=lambda each: each.log_evidence, default=one)
            one = better if better.log_evidence > one.log_evidence else one
        if one.log_evidence < before + 1.0:
            break
    return one


def without(one: Fit, i: int, most: int = 0, reach: float = np.inf) -> Fit | None:
    """The fit without its mechanism number i, in at most so many steps: with none the others and the parameters are as they are,
    for begun anew they would make up for it. reach: as `fit` has it.
    """
    rest = (*one.recipes[:i], *one.recipes[i + 1 :])
    c = np.concatenate([np.zeros(0), *(one.c[own] for j, own in enumerate(one.model.own) if j != i)])
    return fit(type(one.model)(one.model.base, rest), c, one.point.x[: one.model.k], most, reach)
