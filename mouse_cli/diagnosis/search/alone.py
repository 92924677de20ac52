"""Every candidate by itself; and the sets that first looks promise, where those that lead explain nothing."""

from mouse_cli.diagnosis.gates import GATE, ODDS
from mouse_cli.diagnosis.search.fit import Fit
from mouse_cli.diagnosis.search.found import Found, best_of, keep
from mouse_cli.diagnosis.search.moves import added_up, adequate, any_explains, exchanged, renamed
from mouse_cli.diagnosis.search.optima import within
from mouse_cli.diagnosis.search.parts import in_turn, promising, single
from mouse_cli.diagnosis.search.study import Study
from mouse_cli.diagnosis.validate.placed import led

_FIRST = 8  # candidates, the most promising, after which pairs are begun
_MANY, _OF_KIND = 3, 2  # mechanisms of one kind that are begun together, and sets of so many
_FOLLOWING = 25.0  # ln of odds behind the best mechanism up to which its places are told apart by what is held out


def alone(study: Study, baseline: Fit, most: int) -> tuple[list[Fit], Found]:
    """The most probable fit of each candidate, and the sets of up to `most` that were begun.

    Beside a set that explains the data what one mechanism leaves is far from mattering, and few steps of its descents say so.
    """
    fits: list[Fit] = []
    begun, names = Found(), promising(study)
    for some in (names[:_FIRST], names[_FIRST:]):
        in_turn(
            study,
            single,
            [(name,) for name in some],
            lambda _, one: fits.extend([] if one is None else [one]),
            lambda _: within([baseline, *fits, *begun.values()]),
        )
        if most > 1 and not begun and not any(adequate(one, GATE) for one in (baseline, *fits)):
            _begin(study, begun, [baseline, *fits], most)
    return [led(one) if _matters(one, baseline, fits) else one for one in fits], begun


def _begin(study: Study, begun: Found, fits: list[Fit], most: int) -> None:
    """Into `begun` pairs, and where none explains the data two or three of one kind, whose effects add up best.

    Of three flexible feet none leads, nor do two. What leads may be all of them by another of its group: feet that are held in
    elastic walls for such as turn, of which one beside two others is no better than it was.
    """
    added_up(study, 2, begun, fits)
    if any_explains(begun, GATE):
        return
    for name in study.known:
        for count in range(2, min(most, _MANY) + 1):
            added_up(study, count, begun, fits, name, _OF_KIND)
    for best in best_of(begun, 1):
        group = best.recipes[0].candidate.group
        names = tuple(name for name, each in study.known.items() if each.group == group)
        if all(recipe.candidate.group == group for recipe in best.recipes):
            for name in names:
                if any(recipe.candidate.key != name for recipe in best.recipes):
                    keep(begun, renamed(study, best, name))
            keep(begun, exchanged(study, best_of(begun, 1)[0], names))


def _matters(one: Fit, baseline: Fit, fits: list[Fit]) -> bool:
    """Whether a mechanism says more than none, and is so near the best that what is held out may make it that."""
    best = max(each.log_evidence for each in fits)
    return one.log_evidence > max(baseline.log_evidence + ODDS, best - _FOLLOWING)
