"""A sensor that reads a multiple of what it should."""

import numpy as np

from mouse_cli.diagnosis.effects.change import Change, Recipe, Unknown
from mouse_cli.diagnosis.effects.sensors import changed, regressed, row, share, site, with_readings, worst_sensors
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.mechanisms import Candidate


def recipes(model: Reduced, candidate: Candidate) -> list[Recipe]:
    """y_s -> g y_s for each sensor s, in all modes."""
    return [_recipe(model, candidate, k) for k in worst_sensors(model)]


def _recipe(model: Reduced, candidate: Candidate, k: int) -> Recipe:
    gain = Unknown("gain", "1", 0.05, 20.0)  # as of units that are confused, 9.81
    where, start = site(model.problem, k), np.array([[regressed(model, k, (gain.lower, gain.upper))]])
    change = lambda values: Change(sensing=changed(model, {k: values[0] * model.sensing[k]}))
    extend = lambda problem, values: with_readings(problem, {k: values[0] * row(problem, k)})
    return Recipe(candidate, (gain,), change, start, lambda values: where, 0, share(model), extend)


CANDIDATE = Candidate(
    "sensor-gain",
    "a wrong gain of a sensor",
    "sensor",
    "one sensor reads the same multiple in all modes, and no frequency is touched: calibration, unit, amplifier",
    recipes,
)
