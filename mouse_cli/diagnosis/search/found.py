"""Sets of mechanisms that a search has found, the best fit of each, and what it has tried."""

from collections import Counter
from collections.abc import Mapping
from itertools import combinations

import numpy as np

from mouse_cli.diagnosis.gates import MATERIAL
from mouse_cli.diagnosis.search.fit import Fit
from mouse_cli.diagnosis.search.superposed import text

_OPPOSED = ({"added-stiffness", "local-stiffness"}, {"added-mass", "mass-loss"}, {"mass", "mass-loss"})  # groups
_TRIFLE = 0.01  # of a range, or of a prior standard deviation, by which two places to begin from are as one


def key(one: Fit) -> tuple[str, ...]:
    """Keys of the mechanisms of a fit, sorted; of several parts that of each, for they take as many sizes as so many mechanisms."""
    return tuple(sorted(recipe.candidate.key for recipe in one.recipes for _ in recipe.parts or (None,)))


class Found(dict[tuple[str, ...], Fit]):
    """The best fit of each set of candidates; what was tried beside what is there already is not tried again."""

    def __init__(self, known: Mapping[tuple[str, ...], Fit] | None = None) -> None:
        super().__init__(known or {})
        self._tried: list[tuple[str, Fit]] = []

    def untried(self, first: Fit, names: list[str]) -> list[str]:
        """Those of `names` that were not tried beside the same causes as in `first` at nearly the same x."""
        known = {name for name, other in self._tried if _alike(first, other)}
        new = [name for name in names if name not in known]
        self._tried += [(name, first) for name in new]
        return new


def best_of(found: Mapping[tuple[str, ...], Fit], count: int) -> list[Fit]:
    """The best of them."""
    return sorted(found.values(), key=lambda one: -one.log_evidence)[:count]


def keep(found: Found, one: Fit | None) -> None:
    """Into `found` a fit that is better than what is there, and none of whose mechanisms undoes another."""
    if one is None or _undone(one):
        return
    other = found.get(key(one))
    if other is None or one.log_evidence > other.log_evidence:
        found[key(one)] = one


def _undone(one: Fit) -> bool:
    """Whether two mechanisms of a set are opposed at the very same elements: what is left, their mass or stiffness alone,
    has a name of its own.
    """
    at = [(recipe.candidate.group, site.kind, site.ids) for recipe, site in zip(one.recipes, one.sites, strict=True)]
    return any(a[1:] == b[1:] and {a[0], b[0]} in _OPPOSED for a, b in combinations(at, 2) if a[2])


def material(one: Fit, smaller: list[Fit]) -> bool:
    """Whether every mechanism of a set is needed: what it gains over the best of its parts."""
    own, size = Counter(key(one)), lambda each: (len(key(each)), len(each.recipes))
    parts = [each.log_evidence for each in smaller if size(each) < size(one) and Counter(key(each)) <= own]
    return not parts or one.log_evidence - max(parts) > MATERIAL


def replaced(found: list[Fit], better: list[Fit]) -> list[Fit]:
    """All of both, but for what one of the same kind in `better` is better than."""
    known = {key(one) for one in better}
    return [one for one in found if key(one) not in known] + better


def _alike(one: Fit, other: Fit) -> bool:
    """Whether both are the same causes at places, sizes and parameters that are as one to begin from."""
    if list(map(text, one.recipes)) != list(map(text, other.recipes)) or key(one) != key(other):
        return False
    if one.point.x.shape != other.point.x.shape:  # the same name with another number of sizes
        return False
    wide = np.concatenate([np.ones(one.model.k), one.model.width])
    return bool((np.abs(one.point.x - other.point.x) <= _TRIFLE * wide).all())
