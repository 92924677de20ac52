"""Both that Euler and Bernoulli leave out: shear flexibility, and the inertia of sections that turn."""

import numpy as np

from mouse_cli.diagnosis.effects.change import Change, Recipe, Unknown, steps
from mouse_cli.diagnosis.effects.shearing import shear, shear_range, slender, with_shear
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.mechanisms import Candidate
from mouse_cli.diagnosis.sites.reasons import bars
from mouse_cli.model.problem import Problem


def recipes(model: Reduced, candidate: Candidate) -> list[Recipe]:
    """Timoshenko's bar with rotary inertia from the section itself."""
    if not slender(model):
        return []
    ratio = Unknown("E / (kappa G)", "1", *shear_range(model.bars))

    def change(values: np.ndarray) -> Change:
        return shear(model, values[0], turning=True)

    def extend(problem: Problem, values: np.ndarray) -> Problem:
        return with_shear(problem, values[0], turning=True)

    return [Recipe(candidate, (ratio,), change, steps(ratio, 8)[:, None], extend=extend)]


CANDIDATE = Candidate(
    "timoshenko",
    "shear flexibility and rotary inertia",
    "shear",
    "Timoshenko's bar: shear flexibility together with the inertia of turning sections, which always come together",
    recipes,
    bars,
)
