"""Two sensors whose cables were exchanged."""

from itertools import combinations

import numpy as np

from mouse_cli.diagnosis.effects.change import Recipe
from mouse_cli.diagnosis.effects.sensors import exchanged, misread, worst_sensors
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.mechanisms import Candidate

_WORST = 5  # sensors among which pairs are tried


def recipes(model: Reduced, candidate: Candidate) -> list[Recipe]:
    """y_s <-> y_t for pairs of the sensors that fit worst; the prior is that of all pairs."""
    s, y = model.data.test.s, model.sensing
    prior = -float(np.log(max(s * (s - 1) / 2, 1)))
    corrected = lambda i, j: lambda problem: exchanged(problem, i, j)
    pairs = combinations(worst_sensors(model, _WORST), 2)
    return [misread(model, candidate, {i: y[j], j: y[i]}, prior, corrected(i, j)) for i, j in pairs]


CANDIDATE = Candidate(
    "sensor-swap",
    "two sensors exchanged",
    "sensor",
    "the readings of two sensors are exchanged in all modes",
    recipes,
)
