"""Mechanisms without what they do not need: parts with a size of their own, and sizes beyond those of a plainer mechanism."""

from collections.abc import Iterator

import numpy as np

from mouse_cli.diagnosis.gates import MATERIAL
from mouse_cli.diagnosis.search.fit import Fit, fit
from mouse_cli.diagnosis.search.study import Study


def pared(one: Fit, study: Study) -> Fit:
    """The fit without such parts as gain less than MATERIAL: a foot that is hardly flexible is none of those that are."""
    if not any(len(recipe.parts) > 1 for recipe in one.recipes):
        return one
    best = max(_fewer(one, study.about(one)), key=lambda each: each.log_evidence, default=None)
    return one if best is None or best.log_evidence < one.log_evidence - MATERIAL else pared(best, study)


def _fewer(one: Fit, there: Study) -> Iterator[Fit]:
    """Fits of the same with one part less."""
    own, k, base = there.own(one.recipes), one.model.k, there.model.judged_by(one.data)
    for j, recipe in enumerate(own):
        for i in range(len(recipe.parts)):
            rest = (*recipe.parts[:i], *recipe.parts[i + 1 :])
            known = [each for each in there.recipes(recipe.candidate.key) if each.parts == rest != ()]
            each_has = len(recipe.unknowns) // len(recipe.parts)
            first = one.model.own[j].start + i * each_has
            c = np.delete(one.c, slice(first, first + each_has))
            models = [there.kind(base, (*own[:j], each, *own[j + 1 :])) for each in known]
            yield from (again for model in models if (again := fit(model, c, one.point.x[:k])) is not None)


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
