"""Which fits are of one optimum, whose evidence counts once, and from which misfit on a fit is no rival."""

from collections.abc import Iterable

import numpy as np

from mouse_cli.diagnosis.evidence import capped
from mouse_cli.diagnosis.search.fit import Fit, cost_at, normal

_RISE, _BETWEEN = 1.0, (0.25, 0.5, 0.75)  # of the misfit between two fits, and where it is looked for, that parts them
FAR = 200.0  # misfit above the best one, by its degrees of freedom, from which on a fit is no rival
TIED = 6.0  # misfit above the best up to which other places are as good
BEYOND = 100.0  # times the misfit that matters, from which on what descents begin with, or end at, is far from explaining the data
NEAR = 40.0  # the same of fits of the same causes at other places, of which the best alone is kept


def within(found: Iterable[Fit], far: float = FAR) -> float:
    """Misfit above which a fit can be no rival of the best of `found`; infinite where nothing was found."""
    least = min(found, key=lambda one: one.misfit, default=None)
    return np.inf if least is None else least.misfit + far * max(1.0, least.misfit / max(least.dof, 1))


def distinct(found: list[Fit]) -> list[Fit]:
    """The fits in the order of their evidence, one of each optimum."""
    apart: list[Fit] = []
    for one in sorted(found, key=lambda one: -one.log_evidence):
        if not any(_same(one, other) for other in apart):
            apart.append(one)
    return apart


def _same(one: Fit, other: Fit) -> bool:
    """Whether both are one optimum: within two standard deviations, or with no rise of the misfit on the way between them.

    Both weighed by what is left over at the better of them. By posterior distances and misfits alone, it is the same in any units.
    With a mode of a cause's own between other modes or beyond them, they are two: one of them lacks it in the test.
    """
    if [recipe.number for recipe in one.recipes] != [recipe.number for recipe in other.recipes]:
        return False
    if any(recipe.own for recipe in one.recipes) and _paired(one) != _paired(other):
        return False
    least = min(one, other, key=lambda each: each.misfit)
    scale = max(1.0, least.misfit / max(least.dof, 1))
    apart, k = other.point.x - one.point.x, one.model.k
    near = min(apart[k:] @ np.linalg.solve(each.covariance[k:, k:], apart[k:]) for each in (one, other))
    rise = scale * _RISE + max(one.misfit, other.misfit)
    return bool(near < 4 * scale) or all(_passed(one, apart, share) < rise for share in _BETWEEN)


def _paired(one: Fit) -> list[list[int]]:
    """Model modes that the measured ones are, in each arrangement."""
    return [at.modes.tolist() for _, at in one.model.parts(one.point)]


def _passed(one: Fit, apart: np.ndarray, share: float) -> float:
    """The misfit at a share of the way `apart` from a fit, where the rest adapts by a step across it in the metric of H."""
    model, k = one.model, one.model.k
    at = model.point(one.point.x + share * apart)
    if at is None:
        return np.inf
    H, pull = normal(model, at)
    H = capped(H, model.width)
    step = np.linalg.solve(H, pull) - apart * (apart @ pull) / (apart @ H @ apart)
    beside = at.x + step
    beside[k:] = np.clip(beside[k:], *model.bounds.T)
    return min(cost_at(each, k) for each in (at, model.point(beside)) if each is not None)
