"""Which starts, and which ends of brief descents, are worth going on from."""

import numpy as np

from mouse_cli.diagnosis.gates import SAME_SITE
from mouse_cli.diagnosis.likelihoods.modal.model import Model
from mouse_cli.diagnosis.likelihoods.modal.scales import span
from mouse_cli.diagnosis.search.fit import End
from mouse_cli.model.site import gap

_EACH = 4  # starts at least from one recipe
_APART = 0.08  # of a range: between starts of one recipe
_TOLD = 0.05  # squared distance of what two places predict, by the data's sd, up to which they are as one


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
    """Whether both are at one place and predict the same, as two nodes through the thickness of a plate do."""
    reach = SAME_SITE * span(one.model.base)
    near = all(gap(a, b) <= reach for a, b in zip(one.sites, other.sites, strict=True))
    return near and bool(np.sum((one.point.residual - other.point.residual) ** 2) < _TOLD * (1 + 1e-2 * one.misfit))


def leading(led: list, new: tuple[int, np.ndarray, End]) -> list:
    """Ends of descents with a further one among them, the best first and no two alike."""
    if any(cost(one) <= cost(new[2]) and _alike(one, new[2]) for *_, one in led):
        return led
    others = [each for each in led if cost(each[2]) <= cost(new[2]) or not _alike(each[2], new[2])]
    return sorted([*others, new], key=lambda item: cost(item[2]))
