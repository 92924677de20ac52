"""An open crack across a bar of rectangular section."""

import numpy as np

from mouse_cli.diagnosis.candidates import Candidate
from mouse_cli.diagnosis.change import Recipe, Unknown, steps
from mouse_cli.diagnosis.fracture import bending, shearing
from mouse_cli.diagnosis.hinges import places
from mouse_cli.diagnosis.reduced import Reduced


def recipes(model: Reduced, candidate: Candidate) -> list[Recipe]:
    """F + 6 (1 - nu^2) h F1 / EI [1, eta]'[1, eta] + l/(3 EI) 2 (1 - nu^2) (h/l)^3 F2 on the antisymmetric strain."""
    bars, depth = model.bars, Unknown("depth over height", "1", 0.05, 0.7)

    def added(bar: int, at: float, values: np.ndarray) -> np.ndarray:
        height = np.sqrt(12 * bars.EI[bar] / bars.E[bar] / bars.A[bar])
        b, l, EI = np.array([1.0, 2 * at - 1]), bars.length[bar], bars.EI[bar]
        stiff = 1 - bars.nu[bar] ** 2
        F = 6 * stiff * height * bending(values[0]) / EI * np.outer(b, b)
        F[1, 1] += l / (3 * EI) * 2 * stiff * (height / l) ** 3 * shearing(values[0])
        return F

    return places(model, candidate, (depth,), added, steps(depth, 3))


CANDIDATE = Candidate(
    "crack",
    "an open crack",
    "local-stiffness",
    "an open edge crack across a bar of rectangular section: it gives way in bending, and a little in shear, by its depth "
    "(linear fracture mechanics)",
    recipes,
)
