"""Mechanisms without what they do not need: directions in which they give, and sizes beyond those of a plainer mechanism."""

from collections.abc import Iterator

import numpy as np

from mouse_cli.diagnosis.effects.change import Recipe
from mouse_cli.diagnosis.gates import MATERIAL
from mouse_cli.diagnosis.search.fit import Fit, fit
from mouse_cli.diagnosis.search.study import Study


def pared(one: Fit, study: Study) -> Fit:
    """The fit without such directions as gain less than MATERIAL: a foot that is hardly flexible is none of those that are, nor is
    one that gives along one axis flexible along others.
    """
    if not any(len(recipe.dofs) > 1 for recipe in one.recipes):
        return one
    best = max(_fewer(one, study.about(one)), key=lambda each: each.log_evidence, default=None)
    return one if best is None or best.log_evidence < one.log_evidence - MATERIAL else pared(best, study)


def _fewer(one: Fit, there: Study) -> Iterator[Fit]:
    """Fits of the same with as few degrees of freedom less as there are recipes for."""
    own, k, base = there.own(one.recipes), one.model.k, there.model.judged_by(one.data)
    for j, recipe in enumerate(own):
        first = one.model.own[j].start
        for fewer in _within(recipe, there.recipes(recipe.candidate.key) if len(recipe.dofs) > 1 else []):
            left_out = [first + i for i, dof in enumerate(recipe.dofs) if dof not in fewer.dofs]
            model = there.kind(base, (*own[:j], fewer, *own[j + 1 :]))
            again = fit(model, np.delete(one.c, left_out), one.point.x[:k])
            if again is not None:
                yield again


def _within(recipe: Recipe, others: list[Recipe]) -> list[Recipe]:
    """Those of `others` that have some degrees of freedom of a recipe, in its order, and that no other of them has more of."""
    some = [each for each in others if each.dofs and each.dofs == tuple(dof for dof in recipe.dofs if dof in each.dofs)]
    less = [each for each in some if len(each.dofs) < len(recipe.dofs)]
    return [each for each in less if not any(set(each.dofs) < set(other.dofs) for other in less)]


def plainest(fits: list[Fit]) -> list[Fit]:
    """The fits without those that explain the data no better than the mechanism that they are where a further size vanishes.

    Better: by a log likelihood of MATERIAL. A rotary inertia that data do not feel makes a mass no other mechanism, yet at a node
    it would not pay for a place along a member, as the mass alone does.
    """
    best = {tuple(sorted(recipe.candidate.key for recipe in one.recipes)): one.misfit for one in fits if one.recipes}
    return [one for one in fits if one.misfit < best.get(_plain(one), np.inf) - 2 * MATERIAL or _plain(one) == ()]


def _plain(one: Fit) -> tuple[str, ...]:
    """Keys of the plainer mechanisms of a fit; () where it has none."""
    found = tuple(sorted(recipe.candidate.plain or recipe.candidate.key for recipe in one.recipes))
    return found if any(recipe.candidate.plain for recipe in one.recipes) else ()
