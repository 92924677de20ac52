"""The mass of sensors and their cables."""

import numpy as np

from mouse_cli.diagnosis.effects.change import Change, Recipe, Unknown, steps
from mouse_cli.diagnosis.extend.edit import Edit
from mouse_cli.diagnosis.extend.matrices import of_matrices, with_entries
from mouse_cli.diagnosis.extend.points import found
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.likelihoods.modal.scales import total_mass
from mouse_cli.diagnosis.mechanisms import Candidate
from mouse_cli.model.diagnosis import Site
from mouse_cli.model.problem import Problem
from mouse_cli.model.units import KILOGRAM

# Of the mass of the structure, shared by the sensors: what may be felt, and what nobody would mount
_FELT, _LARGEST = 1e-3, 0.1
_HEAVIEST = 20.0  # kg of a sensor with its base plate and cable: geophones and servo accelerometers weigh less


def _most(model: Reduced, each: float) -> float:
    """The mass of the heaviest sensor in the unit of the deck, `each` the mass of the structure for each sensor."""
    kilogram = KILOGRAM.get(model.problem.units.mass)
    return min(_LARGEST * each, _HEAVIEST * kilogram) if kilogram else _LARGEST * each


def _why(model: Reduced) -> str:
    """Why it has no site."""
    if not model.data.test.s:
        return "the test has no sensors"
    return f"no sensor is heavy enough to be felt: {_HEAVIEST:g} kg each, in {model.problem.units.mass}, beside the structure"


def recipes(model: Reduced, candidate: Candidate) -> list[Recipe]:
    """M + m sum B'B, B the translations of each place with a sensor, or what a sensor without a place reads."""
    test, structure = model.data.test, model.problem.structure
    if not test.s:
        return []
    geometry, dofs = structure.geometry, np.unique(test.dofs)
    nodes = np.zeros(0, int)
    if geometry is not None:
        nodes = np.unique(geometry.node[dofs])
        dofs = np.flatnonzero(np.isin(geometry.node, nodes[nodes >= 0]) & (geometry.direction < 3))
    if not len(dofs):
        return []
    rows = model.V[dofs] if model.motion is None else np.concatenate([model.node(int(i))[:3] for i in nodes if i >= 0])
    M = rows.T @ rows
    each = total_mass(model) / max(len(nodes), 1 if len(nodes) else len(dofs))
    if (most := _most(model, each)) <= _FELT * each:
        return []
    m = Unknown("mass of each sensor", "kg", _FELT * each, most)
    site = Site("sensor", tuple(structure.labels[i] for i in np.unique(test.dofs)), None, "at every sensor")

    def extend(problem: Problem, values: np.ndarray) -> Problem:
        if of_matrices(problem):
            return with_entries(
                problem, found("mass of each sensor", values[0], "kg"), M=(dofs, dofs, np.ones(len(dofs)))
            )
        edit = Edit(problem)
        at = [[edit.index(int(model.problem.mesh.node_ids[i]))] for i in nodes if i >= 0]
        edit.bind("mass of each sensor", edit.add("mass", at, {"mass": values[0]}), ("mass",), unit="kg")
        return edit.done()

    return [
        Recipe(
            candidate,
            (m,),
            lambda values: Change(M=values[0] * M),
            steps(m, 4)[:, None],
            lambda values: site,
            extend=extend,
        )
    ]


CANDIDATE = Candidate(
    "sensor-mass",
    "the mass of the sensors",
    "sensor-mass",
    "mass loading by sensors and cables that are heavy for what they are mounted on, the same mass at each: at most a tenth of the "
    "structure, and 20 kg where the deck declares its units",
    recipes,
    _why,
    lasting=True,
)
