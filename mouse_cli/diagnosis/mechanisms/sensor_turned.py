"""A sensor of several axes that is mounted turned, by a right angle or half a turn."""

from itertools import combinations

import numpy as np

from mouse_cli.diagnosis.effects.change import Recipe
from mouse_cli.diagnosis.effects.sensors import misread, row, with_readings, worst_sensors
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.mechanisms import Candidate
from mouse_cli.model.problem import Problem

# signs of what the one reads of the other, and that one of the first; of half a turn each reads less of itself
_TURNS = {"90 degrees": (1, -1), "270 degrees": (-1, 1), "180 degrees": (0, 0)}
_WORST = 5  # sensors one of which is among those that are turned


def recipes(model: Reduced, candidate: Candidate) -> list[Recipe]:
    """y_s -> y_t and y_t -> -y_s for pairs of one node, the other way round, and both turned over; the prior is that of all."""
    pairs, worst = _pairs(model.problem), set(worst_sensors(model, _WORST))
    prior = -float(np.log(max(len(_TURNS) * len(pairs), 1)))
    return [_recipe(model, candidate, *pair, turn, prior) for pair in pairs if worst.intersection(pair) for turn in _TURNS]


def _pairs(problem: Problem) -> list[tuple[int, int]]:
    """Sensors of two directions of one node, in the order of their axes."""
    at, by_node = problem.structure.geometry, {}
    for k, dof in enumerate([] if at is None else problem.test.dofs.tolist()):
        if at.node[dof] >= 0 and at.direction[dof] < 3:
            by_node.setdefault(int(at.node[dof]), {})[int(at.direction[dof])] = k
    return [(own[a], own[b]) for own in by_node.values() for a, b in combinations(sorted(own), 2)]


def _recipe(model: Reduced, candidate: Candidate, i: int, j: int, turn: str, prior: float) -> Recipe:
    one, other = _TURNS[turn]
    read = lambda own, beside: {i: one * beside, j: other * own} if one else {i: -own, j: -beside}
    corrected = lambda problem: with_readings(problem, read(row(problem, i), row(problem, j)))
    return misread(model, candidate, read(model.sensing[i], model.sensing[j]), prior, corrected, f"turned by {turn}")


CANDIDATE = Candidate(
    "sensor-turned",
    "a sensor turned",
    "sensor",
    "two axes of the sensor of one node read what a sensor turned about the third by 90, 180 or 270 degrees reads, in all modes",
    recipes,
)
