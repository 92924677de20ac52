"""Laws of damping of a cause: what its spring loses in a cycle.

The spring k of the cause becomes k g(omega): the same g as that of the rest of the structure; structural, g = 1 + i eta; viscous,
g = 1 + i eta omega / omega_0 with omega_0 the middle of the band.
"""

from dataclasses import replace

import numpy as np

from mouse_cli.diagnosis.effects.change import LOST, Recipe, Unknown
from mouse_cli.diagnosis.likelihoods.frf.extend import with_loss, with_loss_of_the_rest
from mouse_cli.model.problem import Problem

SAME, STRUCTURAL, VISCOUS = "", "structural", "viscous"
LAWS = (SAME, STRUCTURAL, VISCOUS)
GROUPS = ("local-stiffness", "ground-spring", "oscillator", "support")  # whose spring may have a loss of its own
LOSS = 0.1  # where a search for a loss factor begins
LOSSES = {
    STRUCTURAL: Unknown("loss factor", "1", 1e-3, 2.0),
    VISCOUS: Unknown("loss factor in mid-band", "1", 1e-3, 2.0),
}


def lossy(recipe: Recipe, law: str, middle: float) -> Recipe:
    """The cause of `recipe` whose spring has a loss factor of its own, the last of its unknowns; middle: omega_0, rad/s."""
    if law == SAME or recipe.law != SAME or recipe.candidate.group not in GROUPS:
        return recipe
    count = len(recipe.unknowns)

    def extend(problem: Problem, values: np.ndarray) -> Problem:
        name, loss = ("loss_factor", values[-1]) if law == STRUCTURAL else ("stiffness_damping", values[-1] / middle)
        deck = recipe.extend(problem, values[:count])
        if recipe.unknowns[0].name != LOST:
            return with_loss(deck, problem, name, float(loss))
        left, own = (1 - values[0]) / values[0], recipe.site(values[:count])
        return with_loss_of_the_rest(deck, problem, name, float(loss), left, own.ids)

    return replace(
        recipe,
        unknowns=(*recipe.unknowns, LOSSES[law]),
        change=lambda values: recipe.change(values[:count]),
        site=lambda values: recipe.site(values[:count]),
        limit=lambda values: recipe.limit(values[:count]),
        grid=np.hstack([recipe.grid, np.full((len(recipe.grid), 1), LOSS)]),
        extend=recipe.extend and extend,
        law=law,
    )
