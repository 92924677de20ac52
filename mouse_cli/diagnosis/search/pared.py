"""Mechanisms of several parts, each with a size of its own, without those parts that they do not need."""

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
    own, k = there.own(one.recipes), one.model.k
    for j, recipe in enumerate(own):
        for i in range(len(recipe.parts)):
            rest = (*recipe.parts[:i], *recipe.parts[i + 1 :])
            known = [each for each in there.recipes(recipe.candidate.key) if each.parts == rest != ()]
            c = np.delete(one.c, one.model.own[j].start + i)
            models = [there.kind(there.model, (*own[:j], each, *own[j + 1 :])) for each in known]
            yield from (again for model in models if (again := fit(model, c, one.point.x[:k])) is not None)
