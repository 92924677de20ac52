"""An open crack across a bar of rectangular section."""

import numpy as np

from mouse_cli.diagnosis.candidates import Candidate
from mouse_cli.diagnosis.change import Recipe, Unknown, steps
from mouse_cli.diagnosis.fracture import bending, shearing
from mouse_cli.diagnosis.hinges import places, with_hinge
from mouse_cli.diagnosis.reduced import Reduced
from mouse_cli.model.problem import Problem


def recipes(model: Reduced, candidate: Candidate) -> list[Recipe]:
    """F + 6 (1 - nu^2) h F1 / EI [1, eta]'[1, eta] + l/(3 EI) 2 (1 - nu^2) (h/l)^3 F2 on the antisymmetric strain."""
    bars, depth = model.bars, Unknown("depth over height", "1", 0.05, 0.7)

    def compliances(bar: int, depth: float) -> tuple[float, float]:
        """Angle for a unit moment, sliding for a unit force."""
        height = np.sqrt(12 * bars.EI[bar] / bars.E[bar] / bars.A[bar])
        c = (1 - bars.nu[bar] ** 2) * height / bars.EI[bar]
        return 6 * c * bending(depth), c * height**2 * shearing(depth) / 6

    def added(bar: int, at: float, values: np.ndarray) -> np.ndarray:
        turning, sliding = compliances(bar, values[0])
        b = np.array([1.0, 2 * at - 1])
        F = turning * np.outer(b, b)
        F[1, 1] += 4 / bars.length[bar] ** 2 * sliding
        return F

    def extend(problem: Problem, bar: int, at: float, values: np.ndarray) -> Problem:
        turning, sliding = compliances(bar, values[0])
        return with_hinge(problem, bars, bar, at, f"crack in {bars.site(bar, at).text}", 1 / turning, 1 / sliding)

    return places(model, candidate, (depth,), added, steps(depth, 3), extend)


CANDIDATE = Candidate(
    "crack",
    "an open crack",
    "local-stiffness",
    "an open edge crack across a bar of rectangular section: it gives way in bending, and a little in shear, by its depth "
    "(linear fracture mechanics)",
    recipes,
)
