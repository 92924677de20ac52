"""Two sensors whose cables were exchanged."""

from itertools import combinations

import numpy as np

from mouse_cli.diagnosis.effects.change import Change, Recipe
from mouse_cli.diagnosis.effects.sensors import changed, exchanged, site, suspects
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.mechanisms import Candidate
from mouse_cli.model.problem import Problem

_WORST = 5  # sensors among which pairs are tried


def recipes(model: Reduced, candidate: Candidate) -> list[Recipe]:
    """y_s <-> y_t for pairs of the sensors that fit worst; the prior is that of all pairs."""
    s = model.data.test.s
    prior = -float(np.log(max(s * (s - 1) / 2, 1)))
    return [_recipe(model, candidate, i, j, prior) for i, j in combinations(suspects(model, _WORST), 2)]


def _recipe(model: Reduced, candidate: Candidate, i: int, j: int, prior: float) -> Recipe:
    sensing = changed(model, {i: model.sensing[j], j: model.sensing[i]})
    where = site(model.problem, i, j)

    def extend(problem: Problem, values: np.ndarray) -> Problem:
        return exchanged(problem, i, j)

    return Recipe(
        candidate,
        (),
        lambda values: Change(sensing=sensing),
        np.zeros((1, 0)),
        lambda values: where,
        log_prior=prior,
        extend=extend,
    )


CANDIDATE = Candidate(
    "sensor-swap",
    "two sensors exchanged",
    "sensor",
    "the readings of two sensors stand in each other's place in all modes",
    recipes,
)
