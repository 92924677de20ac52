"""Which starts, and which ends of brief descents, are worth going on from."""

import numpy as np

from mouse_cli.diagnosis.effects.change import Recipe
from mouse_cli.diagnosis.gates import SAME_SITE
from mouse_cli.diagnosis.likelihoods.modal.model import Model
from mouse_cli.diagnosis.likelihoods.modal.scales import span
from mouse_cli.diagnosis.search.fit import End
from mouse_cli.model.site import gap

_EACH = 4  # starts at least from one recipe
_APART = 0.08  # of a range: between starts of one recipe
_FOLLOWED = 40.0  # misfit above the best of an end, by what that leaves, from which on nobody looks around it
_TOLD = 0.05  # squared distance of what two places predict, by the data's sd, up to which they are as one

Led = list[tuple[int, np.ndarray, End]]  # number of the recipe, start and end of brief descents, the best first


def spread(starts: list[tuple[int, np.ndarray]], trials: dict[int, Model], most: int) -> list[tuple[int, np.ndarray]]:
    """The first `most` of `starts` (number of recipe, x), without such as are close to an earlier one of the same recipe."""
    taken: dict[int, list[np.ndarray]] = {}
    found = []
    for number, x in starts:
        trial, own = trials[number], taken.setdefault(number, [])
        at = x[trial.k :] / trial.width
        if len(own) < max(_EACH, most // len(trials)) and all(np.abs(at - other).max() > _APART for other in own):
            own.append(at), found.append((number, x))
        if len(found) == most:
            break
    return found


def cost(one: End) -> float:
    """C - 2 ln prior of the places: one of little prior has to misfit so much less."""
    return one.misfit - 2 * sum(recipe.log_prior for recipe in one.recipes)


def _alike(one: End, other: End) -> bool:
    """Whether both are at one place and predict the same by as many sizes, as two nodes through the thickness of a plate do."""
    if one.model.t != other.model.t:  # more sizes always misfit less, and are weighed against fewer by evidence
        return False
    reach = SAME_SITE * span(one.model.base)
    near = all(gap(a, b) <= reach for a, b in zip(one.sites, other.sites, strict=True))
    return near and bool(np.sum((one.point.residual - other.point.residual) ** 2) < _TOLD * (1 + 1e-2 * one.misfit))


def leading(led: Led, new: tuple[int, np.ndarray, End]) -> Led:
    """Ends of descents with a further one among them, the best first and no two alike."""
    if any(cost(one) <= cost(new[2]) and _alike(one, new[2]) for *_, one in led):
        return led
    others = [each for each in led if cost(each[2]) <= cost(new[2]) or not _alike(each[2], new[2])]
    return sorted([*others, new], key=lambda item: cost(item[2]))


def surrounding(led: Led, trials: dict[int, Model], begun: set[int], count: int, reach: float) -> list[tuple[int, np.ndarray]]:
    """Starts at the `count` nearest places of the same kind that none has `begun` from, around each of `led`, with the sizes there.

    Where a size matters as sharply as the frequency of an oscillator, a first look at sizes of a list says how near one of them is
    rather than how good the place is.
    """
    if not led:
        return []
    recipes = {i: trial.recipes[-1] for i, trial in trials.items() if i not in begun}
    sites = {i: recipe.site(recipe.grid[0]) for i, recipe in recipes.items()}
    best = led[0][2]
    far = min(reach, best.misfit + _FOLLOWED * max(1.0, best.misfit / max(best.model.base.data.dof, 1)))
    found: dict[int, np.ndarray] = {}
    for _, _, end in (each for each in led if each[2].misfit <= far):
        last, own = end.recipes[-1], end.model.own[-1]
        values, sizes = last.values(end.c[own]), _sizes(last)
        alike = [i for i, recipe in recipes.items() if i not in found and _sizes(recipe) == sizes]
        gaps = {i: gap(end.sites[-1], sites[i]) for i in alike}
        for i in sorted((i for i in gaps if np.isfinite(gaps[i])), key=gaps.__getitem__)[:count]:
            found[i] = np.concatenate([end.point.x[: end.model.k + own.start], recipes[i].coordinates(values)])
    return list(found.items())


def _sizes(recipe: Recipe) -> list[tuple[str, str]]:
    """Names and units of the unknowns of a recipe."""
    return [(unknown.name, unknown.unit) for unknown in recipe.unknowns]
