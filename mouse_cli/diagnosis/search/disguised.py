"""Sets of mechanisms that are a field in disguise: several of one group that touch.

Two softer stretches side by side are one profile of stiffness in two steps. Places drawn independently touch in a share of 2 d / L
or so of all cases, d their extent, L that of the structure; what is uneven in itself does in all. At equal likelihood the set has
at most (2 d / L) prior(2) / C(g + 1, 2) against NAMELESS / 4, under 0.01 for the ten groups g and more of a library: whatever the
data, it is never sure. Its probability counts as that of the field.
"""

from collections.abc import Sequence
from itertools import combinations

import numpy as np

from mouse_cli.diagnosis.effects.change import Recipe
from mouse_cli.diagnosis.gates import SAME_SITE
from mouse_cli.diagnosis.likelihoods.modal.scales import span
from mouse_cli.diagnosis.search.fit import Fit

STIFFNESS, MASS, BED = "field-stiffness", "field-mass", "field-bed"  # keys of rivals without a name


def disguised(one: Fit) -> str | None:
    """Key of the field that a fit is in disguise; None: it is none, as laws of recordings, which have no field for a rival."""
    groups = [recipe.candidate.group for recipe in one.recipes]
    if one.data is None or len(set(groups)) == len(groups):
        return None
    for i, j in combinations(range(len(groups)), 2):
        key = _touching(one, i, j) if groups[i] == groups[j] else None
        if key is not None:
            return key
    return None


def _touching(one: Fit, *both: int) -> str | None:
    """What two mechanisms of a fit that touch change together; None where they do not."""
    placed = [(one.recipes[i], one.c[one.model.own[i]]) for i in both]
    bars = [recipe.at(c).softening for recipe, c in placed]
    if None not in bars:
        nodes = [set(one.model.base.first.bars.nodes[each.bars].ravel().tolist()) for each in bars]
        return STIFFNESS if nodes[0] & nodes[1] else None
    sites = [recipe.site(recipe.values(c)).position for recipe, c in placed]
    if None in sites or np.linalg.norm(np.subtract(*sites)) > SAME_SITE * span(one.model.base):
        return None
    return _property(placed)


def _property(placed: Sequence[tuple[Recipe, np.ndarray]]) -> str | None:
    """MASS of what changes masses alone, BED of springs to the ground; None of anything else."""
    changes = [recipe.at(c) for recipe, c in placed]
    if any(recipe.own for recipe, _ in placed):
        return None
    if all(change.K is None and change.M is not None for change in changes):
        return MASS
    return BED if all(change.M is None and change.K is not None for change in changes) else None
