"""A sensor that stands at another node than the deck says, or reads another direction there: a label taken for its neighbour."""

from collections.abc import Iterator

import numpy as np

from mouse_cli.diagnosis.effects.change import Recipe
from mouse_cli.diagnosis.effects.sensors import misread, with_readings, worst_sensors
from mouse_cli.diagnosis.likelihoods.modal.model import Model
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.mechanisms import Candidate
from mouse_cli.model.problem import Problem

_WORST, _NODES = 5, 6  # sensors one of which is at a place that is suspected; nodes that are tried for each place

Mount = dict[int, int]  # number of each sensor that stands at a place, and the degree of freedom (from 0) that it reads


def recipes(model: Reduced, candidate: Candidate) -> list[Recipe]:
    """y_s -> y of the same directions at another node, all sensors of a node together, or of another direction at the same one.

    Those that come nearest to the readings, as the model moves now; the prior is that of all nodes.
    """
    if model.problem.test.sensing is not None:
        return []
    places, worst = _places(model.problem), set(worst_sensors(model, _WORST))
    suspected = [mount for mount in _mounts(model.problem) if worst.intersection(mount)]
    found = _misses(model) if suspected else None
    if found is None:
        return []
    prior = -float(np.log(max(model.data.test.s, 1) * len(places)))
    made = []
    for mount in suspected:
        others = sorted(_others(model.problem, mount, places), key=lambda other: sum(found[k, dof] for k, dof in other.items()))
        made += [_recipe(model, candidate, mount, other, prior) for other in others[:_NODES]]
    return made


def _places(problem: Problem) -> dict[int, dict[int, int]]:
    """Degrees of freedom by node and direction; of a model without geometry each is a place of its own."""
    at, found = problem.structure.geometry, {}
    if at is None:
        return {dof: {0: dof} for dof in range(problem.structure.n)}
    for dof in np.flatnonzero((at.node >= 0) & (at.direction < 3)).tolist():
        found.setdefault(int(at.node[dof]), {})[int(at.direction[dof])] = dof
    return found


def _mounts(problem: Problem) -> list[Mount]:
    """Sensors of each place."""
    at, found = problem.structure.geometry, {}
    for k, dof in enumerate(problem.test.dofs.tolist()):
        if at is None or (at.node[dof] >= 0 and at.direction[dof] < 3):
            found.setdefault(dof if at is None else int(at.node[dof]), {})[k] = dof
    return list(found.values())


def _others(problem: Problem, mount: Mount, places: dict[int, dict[int, int]]) -> Iterator[Mount]:
    """What its sensors may read instead: another node, or one of them another direction of its own, where no other sensor is."""
    at = problem.structure.geometry
    direction = {k: 0 if at is None else int(at.direction[dof]) for k, dof in mount.items()}
    taken = set(problem.test.dofs.tolist())
    for own in places.values():
        if set(mount.values()) <= set(own.values()):
            yield from ({**mount, k: dof} for k in mount for dof in own.values() if dof not in taken)
        elif all(d in own and own[d] not in taken for d in direction.values()):
            yield {k: own[d] for k, d in direction.items()}


def _misses(model: Reduced) -> np.ndarray | None:
    """By how much (s, n) what each degree of freedom does misses the readings of each sensor, by their variances."""
    at, test = Model(model).point(model.z), model.data.test
    if at is None:
        return None
    known = model.data.has_shape
    moved = at.a * at.measured(model.V @ at.X[: model.r])
    w = np.where(known, 1 / np.where(known, test.shape_sd, 1.0) ** 2, 0.0)
    y = np.where(known, test.shapes, 0.0)
    return (w * y**2).sum(axis=1)[:, None] - 2 * (w * y) @ moved.T + w @ (moved**2).T


def _recipe(model: Reduced, candidate: Candidate, mount: Mount, other: Mount, prior: float) -> Recipe:
    n, moved = model.problem.structure.n, {k: dof for k, dof in other.items() if dof != mount[k]}
    rows = {k: np.eye(1, n, dof)[0] for k, dof in moved.items()}
    read = {k: model.V[dof] for k, dof in moved.items()}
    labels = " and ".join(model.problem.structure.labels[dof] for dof in moved.values())
    return misread(model, candidate, read, prior, lambda problem: with_readings(problem, rows), f"at {labels}")


CANDIDATE = Candidate(
    "sensor-node",
    "a sensor at another node",
    "sensor",
    "the sensors of one node are at another one, or one of them reads another direction, in all modes: a label or cable taken for "
    "its neighbour",
    recipes,
)
