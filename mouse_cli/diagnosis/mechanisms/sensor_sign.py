"""A sensor that is mounted backwards."""

from mouse_cli.diagnosis.effects.change import Recipe
from mouse_cli.diagnosis.effects.sensors import misread, row, share, with_readings, worst_sensors
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.mechanisms import Candidate


def recipes(model: Reduced, candidate: Candidate) -> list[Recipe]:
    """y_s -> -y_s for each sensor s, in all modes."""
    corrected = lambda k: lambda problem: with_readings(problem, {k: -row(problem, k)})
    return [misread(model, candidate, {k: -model.sensing[k]}, share(model), corrected(k)) for k in worst_sensors(model)]


CANDIDATE = Candidate(
    "sensor-sign",
    "a sensor that is mounted backwards",
    "sensor",
    "one sensor reads the opposite sign in all modes",
    recipes,
)
