"""Shear flexibility of bars, after Timoshenko, without the inertia of sections that turn."""

import numpy as np

from mouse_cli.diagnosis.effects.change import Change, Recipe, Unknown, steps
from mouse_cli.diagnosis.effects.shearing import shear, shear_range, slender, with_shear
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.mechanisms import Candidate
from mouse_cli.diagnosis.sites.reasons import bars
from mouse_cli.model.problem import Problem


def recipes(model: Reduced, candidate: Candidate) -> list[Recipe]:
    """phi = 12 EI / (kappa G A l^2) of every bar, from E / (kappa G)."""
    if not slender(model):
        return []
    ratio = Unknown("E / (kappa G)", "1", *shear_range(model.bars))

    def change(values: np.ndarray) -> Change:
        return shear(model, values[0], turning=False)

    def extend(problem: Problem, values: np.ndarray) -> Problem:
        return with_shear(problem, values[0], turning=False)

    return [Recipe(candidate, (ratio,), change, steps(ratio, 8)[:, None], extend=extend)]


CANDIDATE = Candidate(
    "shear",
    "shear flexibility",
    "shear",
    "bars give way in shear (Timoshenko): frequencies of high modes fall with the square of their wave number, low ones stay",
    recipes,
    bars,
)
