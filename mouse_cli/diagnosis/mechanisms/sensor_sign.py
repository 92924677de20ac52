"""A sensor that is mounted backwards."""

import numpy as np

from mouse_cli.diagnosis.effects.change import Change, Recipe
from mouse_cli.diagnosis.effects.sensors import changed, row, share, site, suspects, with_readings
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.mechanisms import Candidate
from mouse_cli.model.problem import Problem


def recipes(model: Reduced, candidate: Candidate) -> list[Recipe]:
    """y_s -> -y_s for each sensor s, in all modes."""
    return [_recipe(model, candidate, k) for k in suspects(model)]


def _recipe(model: Reduced, candidate: Candidate, k: int) -> Recipe:
    sensing, where = changed(model, {k: -model.sensing[k]}), site(model.problem, k)

    def extend(problem: Problem, values: np.ndarray) -> Problem:
        return with_readings(problem, {k: -row(problem, k)})

    return Recipe(
        candidate,
        (),
        lambda values: Change(sensing=sensing),
        np.zeros((1, 0)),
        lambda values: where,
        log_prior=share(model),
        extend=extend,
    )


CANDIDATE = Candidate(
    "sensor-sign",
    "a sensor that is mounted backwards",
    "sensor",
    "one sensor reads the opposite sign in all modes",
    recipes,
)
