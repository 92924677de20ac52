"""Ways on from where a descent ends too soon: before the end of a finite element, at a site beside the best, or with two modes
paired crosswise.
"""

from collections.abc import Iterator

import numpy as np

from mouse_cli.diagnosis.effects.change import Recipe
from mouse_cli.diagnosis.evidence import capped
from mouse_cli.diagnosis.gates import GATE
from mouse_cli.diagnosis.likelihoods.modal.model import Model
from mouse_cli.diagnosis.likelihoods.modal.point import Point
from mouse_cli.diagnosis.search.fit import MOST, Fit, cost_at, fit, normal
from mouse_cli.diagnosis.search.optima import TIED
from mouse_cli.diagnosis.search.study import Study
from mouse_cli.updating.chi_square import upper_tail

_SHIFTS = np.array([-5, -3, -2, -1, 1, 2, 3, 5]) / 50  # of the range of a place
_AROUND, _WAYS = 8, 4  # sites next to one that are looked at, and steps from site to site


def shifted(one: Fit) -> Fit:
    """The fit from places nearby: across the end of a finite element the misfit has a step, before which a descent stops."""
    model = one.model
    unknowns = [u for recipe in one.recipes for u in recipe.unknowns]
    for j in (i for i, u in enumerate(unknowns) if not u.log):
        T = np.delete(model.jacobian(one.point), model.k + j, axis=1)
        H = T.T @ T + np.diag((np.arange(T.shape[1]) < model.k).astype(float))
        best, start = one.misfit - 1, None
        for share in _SHIFTS:
            c = one.c.copy()
            c[j] = np.clip(c[j] + share * model.width[j], *model.bounds[j])
            at = model.point(np.concatenate([one.point.x[: model.k], c]))
            if at is None:
                continue
            pull = T.T @ at.residual - np.where(np.arange(T.shape[1]) < model.k, np.delete(at.x, model.k + j), 0.0)
            left = cost_at(at, model.k) - pull @ np.linalg.lstsq(H, pull, rcond=None)[0]
            if left < best:
                best, start = left, c
        again = None if start is None else fit(model, start, one.point.x[: model.k])
        if again is not None and again.misfit < one.misfit:
            one = again
    return one


def walked(one: Fit, study: Study) -> Fit:
    """The fit with each mechanism in turn at the next site but one, as long as that is better.

    Sites that are apart, as nodes are, have no slope between them, and a first look knows few sizes.
    """
    for _ in range(_WAYS):
        before = one
        for i in range(len(one.recipes)):
            one = _stepped(one, study, i)
        if one is before:
            break
    return one


def tied(one: Fit, study: Study) -> list[Fit]:
    """Fits with one mechanism at another of the sites around its own that misfit by less than TIED more: places as good."""
    found = [
        fit(model, one.point.x[one.model.k :], one.point.x[: one.model.k])
        for i in range(len(one.recipes))
        for left, model in _steps(one, study, i)
        if left < one.misfit + TIED
    ]
    return [each for each in found if each is not None and each.misfit < one.misfit + TIED]


def _stepped(one: Fit, study: Study, i: int) -> Fit:
    """The fit with mechanism number i at the best of the sites around its own, by a full step from there; itself if none is."""
    x, k = one.point.x, one.model.k
    left, chosen = min(_steps(one, study, i), key=lambda step: step[0], default=(np.inf, None))
    again = fit(chosen, x[k:], x[:k]) if left < one.misfit - 1 else None
    return again if again is not None and again.misfit < one.misfit - 1 else one


def _steps(one: Fit, study: Study, i: int) -> Iterator[tuple[float, Model]]:
    """The misfit that a full step promises with mechanism number i at each of the sites around its own, and the model there."""
    there = study.about(one)
    own = there.own(one.recipes)
    for recipe in _around(own[i], there):
        model = there.kind(there.model, (*own[:i], recipe, *own[i + 1 :]))
        at = model.point(one.point.x)
        if at is not None:
            yield _after_a_step(model, at), model


def _around(recipe: Recipe, study: Study) -> list[Recipe]:
    """The same mechanism at the sites next to its own; none where its place is an unknown, or acts on more than one place."""
    where = [_fixed(each) for each in study.recipes(recipe.candidate.key)]
    here = _fixed(recipe)
    if here is None:
        return []
    gaps = [np.inf if at is None else float(np.linalg.norm(np.subtract(at, here))) for at in where]
    order = [i for i in np.argsort(gaps, kind="stable").tolist() if 0 < gaps[i] < np.inf]
    made = study.recipes(recipe.candidate.key)
    alike = [made[i] for i in order if [u.name for u in made[i].unknowns] == [u.name for u in recipe.unknowns]]
    return alike[:_AROUND]


def _fixed(recipe: Recipe) -> tuple[float, ...] | None:
    """Position of a recipe's site, whatever its size; None where it has none."""
    if not all(u.log for u in recipe.unknowns) or not len(recipe.grid):
        return None
    return recipe.site(recipe.grid[0]).position


def _after_a_step(model: Model, at: Point) -> float:
    """The misfit that a full step from a point promises."""
    H, pull = normal(model, at)
    return cost_at(at, model.k) - float(pull @ np.linalg.solve(capped(H, model.width), pull))


def uncrossed(one: Fit, most: int = MOST, reach: float = np.inf) -> Fit:
    """The best fit from elsewhere, if it is better, where modes are paired crosswise and noise would not leave so much.

    Two modes whose frequencies must pass one another do so through shapes that neither has: a descent ends before, or behind, where
    parameters should not have brought them. It begins again at the prior mean, and where frequencies alone lead from there.
    """
    model, k = one.model, one.model.k
    if upper_tail(one.misfit, max(one.dof, 1)) > GATE or not any(_crossed(*each) for each in model.parts(one.point)):
        return one
    mean = model.point(np.concatenate([np.zeros(k), one.c]))
    starts = [] if mean is None else [mean.x, _across(model, mean)]
    fits = [fit(model, x[k:], x[:k], most, reach) for x in starts]
    return min([one, *(each for each in fits if each is not None)], key=lambda each: each.misfit)


def _across(model: Model, at: Point) -> np.ndarray:
    """x after a full step by the data of frequencies alone."""
    k = model.k
    rows = np.concatenate([_of_frequencies(each) for each, _ in model.parts(at)])
    T, residual = model.jacobian(at)[rows], at.residual[rows]
    H = capped(T.T @ T + np.diag((np.arange(len(at.x)) < k).astype(float)), model.width)
    x = at.x + np.linalg.solve(H, T.T @ residual - np.where(np.arange(len(at.x)) < k, at.x, 0.0))
    x[k:] = np.clip(x[k:], *model.bounds.T)
    return x


def _of_frequencies(model: Model) -> np.ndarray:
    """Mask (q,) of the data of one arrangement that are frequencies."""
    data = model.base.data
    return np.arange(int(data.has_frequency.sum() + data.has_shape.sum())) < data.has_frequency.sum()


def _crossed(model: Model, at: Point) -> bool:
    """Whether measured modes are paired in another order than that of their frequencies."""
    data = model.base.data
    order = np.argsort(data.test.frequency_hz[data.has_frequency])
    return bool((np.diff(at.modes[data.has_frequency][order]) < 0).any())
