"""Laws of damping of a cause: what its spring loses in a cycle.

The spring k of the cause becomes k g(omega): the same g as that of the rest of the structure; structural, g = 1 + i eta; viscous,
g = 1 + i eta omega / omega_0 with omega_0 the middle of the band.
"""

from dataclasses import dataclass, replace

import numpy as np

from mouse_cli.diagnosis.change import Recipe, Unknown
from mouse_cli.diagnosis.frf.extend import with_loss
from mouse_cli.model.problem import Problem

SAME, STRUCTURAL, VISCOUS = "same", "structural", "viscous"
LAWS = (SAME, STRUCTURAL, VISCOUS)
GROUPS = ("local-stiffness", "ground-spring", "oscillator", "support")  # whose spring may have a loss of its own
_LOSS = Unknown("loss factor", "1", 1e-3, 2.0)


@dataclass(frozen=True)
class Lossy(Recipe):
    """A cause whose spring has a loss factor of its own, the last of its unknowns. law: how it depends on frequency."""

    law: str = SAME

    @property
    def inner(self) -> int:
        """Number of unknowns without the loss factor."""
        return len(self.unknowns) - (self.law != SAME)


def lossy(recipe: Recipe, law: str, middle: float = 1.0, start: float = 0.05) -> Lossy:
    """The cause of `recipe` with a law of its own; middle: omega_0, rad/s."""
    fields = {name: getattr(recipe, name) for name in Recipe.__dataclass_fields__}
    if law == SAME:
        return Lossy(**fields)
    count = len(recipe.unknowns)

    def extend(problem: Problem, values: np.ndarray) -> Problem:
        name, loss = ("loss_factor", values[-1]) if law == STRUCTURAL else ("stiffness_damping", values[-1] / middle)
        return with_loss(recipe.extend(problem, values[:count]), problem, name, float(loss))

    grid = np.hstack([recipe.grid, np.full((len(recipe.grid), 1), start)])
    fields |= {
        "unknowns": (*recipe.unknowns, _LOSS if law == STRUCTURAL else replace(_LOSS, name="loss factor at mid-band")),
        "change": lambda values: recipe.change(values[:count]),
        "site": lambda values: recipe.site(values[:count]),
        "grid": grid,
        "extend": recipe.extend and extend,
    }
    return Lossy(**fields, law=law)
