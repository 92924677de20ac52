"""A sensor that is not quite where the deck says."""

import numpy as np

from mouse_cli.diagnosis.effects.change import Change, Recipe, Unknown
from mouse_cli.diagnosis.effects.sensors import changed, row, row_of_sensor, share, site, with_readings, worst_sensors
from mouse_cli.diagnosis.extend.edit import Edit
from mouse_cli.diagnosis.extend.places import element_at
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.mechanisms import Candidate
from mouse_cli.diagnosis.sites.bars import motion_of
from mouse_cli.diagnosis.sites.lines import Line
from mouse_cli.model.problem import Problem
from mouse_cli.terms.elements import Layout
from mouse_cli.terms.elements import _beam as beam

_REACH = 0.02  # of the length of the line


def recipes(model: Reduced, candidate: Candidate) -> list[Recipe]:
    """y(s) -> y(s + dx) along the row of bars that the sensor stands on."""
    found = []
    for k in worst_sensors(model) if model.bars is not None else ():
        on = row_of_sensor(model, k)
        if on is not None:
            found.append(_recipe(model, candidate, k, *on))
    return found


def _recipe(model: Reduced, candidate: Candidate, k: int, run: Line, s: float, direction: np.ndarray) -> Recipe:
    bars, reach = model.bars, _REACH * run.length
    lower, upper = max(-reach, -s), min(reach, run.length - s)
    dx = Unknown("shift along the bars", "m", lower, upper, log=False)
    here, where = direction @ bars.motion(*run.at(s)), site(model.problem, k)

    def change(values: np.ndarray) -> Change:
        there = direction @ bars.motion(*run.at(s + values[0]))
        return Change(sensing=changed(model, {k: model.sensing[k] + there - here}))

    def extend(problem: Problem, values: np.ndarray) -> Problem:
        edit, axis = Edit(problem), bars.axis[run.members[0]]
        points = [np.array(bars.point(*run.at(x))) for x in (s, s + values[0])]
        old, new = (direction @ _deflected(problem, *element_at(edit, point, axis)) for point in points)
        return with_readings(problem, {k: row(problem, k) + new - old})

    grid = np.array([[lower / 2], [upper / 2]]) if lower < 0 < upper else np.array([[(lower + upper) / 2]])
    return Recipe(candidate, (dx,), change, grid, lambda values: where, 0, share(model), extend)


def _deflected(problem: Problem, element: tuple[int, int], share: float) -> np.ndarray:
    """Displacement (3, n) at a share of the length of a beam (set, member), for each degree of freedom of `problem`."""
    mesh, (s, i) = problem.mesh, element
    nodes = mesh.elements[s].nodes[[i]]
    at = beam.span(Layout(mesh.coordinates[nodes], dict(mesh.elements[s].options)))
    places = (6 * nodes[0][:, None] + np.arange(6)).ravel()
    local, l, x = at.motion[0] @ motion_of(problem).rows(places), at.length[0], share
    N = np.array([1 - 3 * x**2 + 2 * x**3, l * (x - 2 * x**2 + x**3), 3 * x**2 - 2 * x**3, l * (x**3 - x**2)])
    across = [(N * sense) @ local[dofs] for dofs, sense in beam.PLANES]
    return at.axes[0].T @ np.stack([(1 - x) * local[0] + x * local[6], *across])


CANDIDATE = Candidate(
    "sensor-place",
    "a misplaced sensor",
    "sensor",
    "one sensor stands up to 2 % of the length of its row of bars away from where the deck has it",
    recipes,
)
