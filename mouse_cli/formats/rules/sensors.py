"""Rules for sensors: each reads something of this model."""

from dataclasses import dataclass
from difflib import get_close_matches
from typing import NamedTuple

import numpy as np

from mouse_cli.dynamics.interpolation import PointMotion, at_node, at_point
from mouse_cli.formats.draft import Draft
from mouse_cli.formats.sensor import SensorDraft
from mouse_cli.model.arrays import Matrix
from mouse_cli.model.geometry import DIRECTIONS, Geometry
from mouse_cli.model.held_reading import HeldReading
from mouse_cli.terms.constraints import Motion, following

_FEWEST = 3  # sensors whose spread is looked at
_LENGTHS = (1e3, 1e-3, 100, 0.01, 25.4, 1 / 25.4, 39.37007874, 0.0254, 12, 1 / 12)  # units of length to one another
_LOCAL, _BEYOND = 0.05, 5.0  # spread over the size of the structure that sensors may have
_LEAST, _MOST = 0.3, 1.5  # and that they must have in the other unit


@dataclass(frozen=True)
class Sensing:
    """dofs (s,), from 0: the nearest of each sensor; weights (s, n), sparse, None where each reads just its own; names (s,).

    held: what they read where supports hold the model.
    """

    dofs: np.ndarray
    weights: Matrix | None
    names: tuple[str, ...]
    held: tuple[HeldReading, ...] = ()


class Reading(NamedTuple):
    """Degrees of freedom from 0, and their weights; what else is read where supports hold the model."""

    dofs: np.ndarray
    weights: np.ndarray
    held: tuple[HeldReading, ...] = ()


def sensing(draft: Draft, sensors: tuple[SensorDraft, ...], geometry: Geometry | None, n: int) -> Sensing | None:
    """What each of `sensors` reads of a model of n degrees of freedom; None after errors."""
    if geometry is not None and _of_another_size(draft, sensors, geometry):
        return None
    readings = weights(draft, sensors, geometry, n)
    if readings is None:
        return None
    _twice(draft, sensors, readings)
    dofs = np.array([_largest(each, geometry) for each in readings], dtype=int)
    plain = all(len(each.dofs) == 1 and each.weights[0] == 1.0 and not each.held for each in readings)
    names = () if all(sensor.plain for sensor in sensors) and plain else tuple(sensor.name for sensor in sensors)
    return Sensing(dofs, None if plain else rows(readings, n), names, tuple(h for each in readings for h in each.held))


def _largest(reading: Reading, geometry: Geometry | None) -> int:
    """The degree of freedom that a sensor reads most of; of one that a support holds, the nearest of its direction."""
    if len(reading.dofs):
        return int(reading.dofs[np.argmax(np.abs(reading.weights))])
    label = reading.held[0].label
    node, direction = np.flatnonzero(geometry.node_ids == int(label[:-2]))[0], DIRECTIONS.index(label[-2:])
    apart = np.linalg.norm(geometry.coordinates[geometry.node] - geometry.coordinates[node], axis=1)
    return int(np.argmin(np.where(geometry.direction == direction, apart, apart + apart.max(initial=0.0) + 1.0)))


def weights(draft: Draft, sensors: tuple[SensorDraft, ...], geometry: Geometry | None, n: int) -> list[Reading] | None:
    """What each of `sensors` reads; None after errors. Two may read the same."""
    labels = draft.labels if geometry is None else geometry.labels()
    place = {label: i for i, label in enumerate(labels)}
    readings = [_reading(draft, sensor, geometry, place, n) for sensor in sensors]
    return None if any(reading is None for reading in readings) else readings


def rows(readings: list[Reading], n: int) -> Matrix:
    """A row of weights of n degrees of freedom for each reading."""
    from scipy.sparse import csr_array

    ends = np.cumsum([0] + [len(each.dofs) for each in readings])
    dofs, weights = (np.concatenate([each[k] for each in readings]) for k in (0, 1))
    return csr_array((weights, dofs.astype(int), ends), shape=(len(readings), n))


def _reading(
    draft: Draft, sensor: SensorDraft, geometry: Geometry | None, place: dict[str, int], n: int
) -> Reading | None:
    if sensor.weights:
        return _sum(draft, sensor, geometry, place, n)
    if sensor.ground is not None:
        return _carried(draft, sensor, geometry, place, n)
    if geometry is None:
        message = f"{sensor.words} is mounted at a node or a point, but the model is made of matrices without nodes"
        return draft.error("MD329", message, sensor.where, help="give weights: {degree of freedom: 1}")
    motion = _motion(draft, sensor, geometry)
    if motion is None:
        return None
    dofs, weights = motion.along(sensor.direction)
    held = () if sensor.node is None else _held(draft, sensor, sensor.node, sensor.direction)
    if not len(dofs) and not held:
        _unresponsive(draft, sensor, geometry, motion.node, sensor.direction)
        return None
    return Reading(dofs, weights, held)


def _held(draft: Draft, sensor: SensorDraft, number: int, direction: np.ndarray) -> tuple[HeldReading, ...]:
    """What a sensor at the node called `number` reads along `direction` (6,) where a support holds it."""
    if draft.mesh is None:
        return ()
    mesh = draft.mesh.mesh
    held = [(int(mesh.node_ids[node]), d) for node, d in mesh.supports.tolist() if d in mesh.directions]
    return tuple(
        HeldReading(sensor.name, f"{number}{DIRECTIONS[d]}", float(direction[d]))
        for d in range(6)
        if direction[d] and (number, d) in held
    )


def _carried(
    draft: Draft, sensor: SensorDraft, geometry: Geometry | None, place: dict[str, int], n: int
) -> Reading | None:
    """What the ground carries along: all degrees of freedom of its direction; without labels all there are."""
    if geometry is not None:
        direction = np.eye(6)[geometry.direction]
    elif all(label[-2:] in DIRECTIONS for label in place) and place:
        direction = np.eye(6)[[DIRECTIONS.index(label[-2:]) for label in place]]
    elif not sensor.ground.any():
        return Reading(np.arange(n), np.ones(n))
    else:
        direction = np.zeros((n, 6))
    shares = direction @ sensor.ground
    dofs = np.flatnonzero(shares)
    if len(dofs):
        return Reading(dofs, shares[dofs])
    what = "has no direction" if not sensor.ground.any() else "carries nothing along"
    message = f"{sensor.words} {what}: no degree of freedom of the model moves with it"
    return draft.error(
        "MD644", message, sensor.where, help="call it groundTX, groundTY or groundTZ, or give moves: {1: 1, 2: 1}"
    )


def _motion(draft: Draft, sensor: SensorDraft, geometry: Geometry) -> PointMotion | None:
    """How the place of the sensor moves."""
    if sensor.node is not None:
        node = _node(draft, sensor, geometry, sensor.node)
        return None if node is None else at_node(geometry, node, _follows(draft, geometry))
    if sensor.at is None:
        message = f"{sensor.words} names no degree of freedom of the model"
        return draft.error("MD329", message, sensor.where, help="call it 12TY or the like, or take its column out")
    motion = at_point(geometry, sensor.at, _follows(draft, geometry))
    if motion.distance > motion.reach:
        kind = "element" if len(geometry.lines) else "node"
        draft.warn(
            "MD335",
            f"{sensor.words} lies {motion.distance:.4g} m off the nearest {kind}, which is {motion.reach:.4g} m long",
            sensor.where,
            f"the nearest node is {geometry.node_ids[motion.node]}",
            "check the coordinates and their unit, m",
        )
    return motion


def _follows(draft: Draft, geometry: Geometry) -> Motion | None:
    """How nodes move that follow others over the rigid links of a deck; None without any."""
    return following(draft.mesh.mesh, geometry) if draft.mesh is not None and draft.mesh.mesh.links else None


def _of_another_size(draft: Draft, sensors: tuple[SensorDraft, ...], geometry: Geometry) -> bool:
    """Whether coordinates spread over another size than the structure, and over its own in another unit of length; says so."""
    placed = [sensor for sensor in sensors if sensor.at is not None]
    if len(placed) < _FEWEST:
        return False
    own, whole = (
        float(np.linalg.norm(np.ptp(x, axis=0))) for x in (np.array([s.at for s in placed]), geometry.coordinates)
    )
    ratio = own / whole if whole > 0 else 1.0
    factor = next((f for f in _LENGTHS if _LEAST <= ratio * f <= _MOST), None)
    found = factor is not None and not _LOCAL <= ratio <= _BEYOND
    if found:
        message = f"the sensors by coordinates lie within {own:.4g}, and the nodes of the model within {whole:.4g}"
        help = f"give their coordinates in the unit of the model: multiply them by {factor:.6g}; or name the units of the deck"
        draft.error("MD335", message, placed[0].where, help=help)
    return found


def _node(draft: Draft, sensor: SensorDraft, geometry: Geometry, number: int) -> int | None:
    found = np.flatnonzero(geometry.node_ids == number)
    if len(found):
        return int(found[0])
    near = sorted(geometry.node_ids.tolist(), key=lambda known: abs(known - number))[
        :3
    ]  # of any size, as Python has them
    message = f"{sensor.words} is mounted on node {number}, which the model does not have"
    return draft.error(
        "MD329", message, sensor.where, f"numbers near to it: {', '.join(map(str, near))}", "correct the node"
    )


def _unresponsive(draft: Draft, sensor: SensorDraft, geometry: Geometry, node: int, direction: np.ndarray) -> None:
    """Note a sensor that reads 0 whatever the model does, with the nearest place where its direction is free."""
    alike = np.flatnonzero(np.isin(geometry.direction, np.flatnonzero(direction)) & (geometry.node >= 0))
    note = "no node is free to move in its direction"
    if len(alike):
        distance = np.linalg.norm(geometry.coordinates[geometry.node[alike]] - geometry.coordinates[node], axis=1)
        note = f"the nearest degree of freedom in its direction is {geometry.labels()[alike[np.argmin(distance)]]}"
    message = f"{sensor.words} reads nothing: node {geometry.node_ids[node]} cannot move in its direction"
    draft.error(
        "MD328",
        message,
        sensor.where,
        note,
        "correct position or direction, give the node of the support, or leave the sensor out",
    )


def _sum(draft: Draft, sensor: SensorDraft, geometry: Geometry | None, place: dict[str, int], n: int) -> Reading | None:
    """The reading of a sensor that names degrees of freedom."""
    held = tuple(each for name, share in sensor.weights.items() for each in _named(draft, sensor, place, name, share))
    free = {name: share for name, share in sensor.weights.items() if name not in {each.label for each in held}}
    moved = [_moved(draft, sensor, geometry, place, name, n) for name in free]
    if any(each is None for each in moved):
        return None
    given = np.array(list(free.values()), dtype=float)
    numbers = [*given.tolist(), *(each.weight for each in held)]
    if not np.isfinite(numbers).all() or not np.any(numbers):
        message = f"{sensor.words} reads nothing: its weights are {', '.join(f'{w:g}' for w in numbers)}"
        return draft.error("MD328", message, sensor.where, help="give finite weights, at least one of them not 0")
    shares: dict[int, float] = {}
    for (dofs, factors), share in zip(moved, given.tolist(), strict=True):
        for dof, factor in zip(dofs.tolist(), factors.tolist(), strict=True):
            shares[dof] = shares.get(dof, 0.0) + share * factor
    order = sorted(shares)
    return Reading(np.array(order, dtype=int), np.array([shares[dof] for dof in order]), held)


def _named(
    draft: Draft, sensor: SensorDraft, place: dict[str, int], name: int | str, share: float
) -> tuple[HeldReading, ...]:
    """What a sensor that names `12TY` reads where a support holds that; nothing of a degree of freedom that the model has."""
    known = isinstance(name, str) and name not in place and name[-2:] in DIRECTIONS and name[:-2].isdecimal()
    return _held(draft, sensor, int(name[:-2]), share * np.eye(6)[DIRECTIONS.index(name[-2:])]) if known else ()


def _moved(
    draft: Draft, sensor: SensorDraft, geometry: Geometry | None, place: dict[str, int], name: int | str, n: int
) -> tuple[np.ndarray, np.ndarray] | None:
    """The degrees of freedom, from 0, and factors that move what a number or a label names: one, or those of a rigid link.

    A number in quotes that is no label is the number.
    """
    if isinstance(name, str) and name not in place and name.isdecimal():
        name = int(name)
    if isinstance(name, int):
        if 1 <= name <= n:
            return np.array([name - 1]), np.ones(1)
        message = f"measured degree of freedom {name} is outside 1 to {n}"
        return draft.error("MD323", message, sensor.where, help=f"give numbers from 1 to {n}")
    if name in place:
        return np.array([place[name]]), np.ones(1)
    direction = name[-2:]
    if geometry is not None and direction in DIRECTIONS and name[:-2].isdecimal():
        node = _node(draft, sensor, geometry, int(name[:-2]))
        along = np.eye(6)[DIRECTIONS.index(direction)]
        if node is None:
            return None
        dofs, factors = at_node(geometry, node, _follows(draft, geometry)).along(along)
        return (dofs, factors) if len(dofs) else _unresponsive(draft, sensor, geometry, node, along)
    near = get_close_matches(name, place, 3) or list(place)[:12]
    known = f"labels of the model: {', '.join(near)}" if place else "the model has no labels"
    message = f"{sensor.words} names '{name[:40]}', which is no label of the model and no sensor"
    if sensor.plain:
        message = f"test.modes.dofs names '{name[:40]}', which is no label of the model and no sensor"
    return draft.error(
        "MD225", f"{message}; {known}", sensor.where, help="give a number, a label, or a sensor of test.sensors"
    )


def _twice(draft: Draft, sensors: tuple[SensorDraft, ...], readings: list[Reading]) -> None:
    """Two sensors that read the same, whatever their sign, are one datum counted twice.

    Two that read one sum of several degrees of freedom, under two names or on two nodes, are two: corners of a rigid body.
    """
    seen: dict[tuple, str] = {}
    mesh = None if draft.mesh is None else draft.mesh.mesh
    followers = set() if mesh is None else {str(mesh.node_ids[link.dependent]) for link in mesh.links}
    for sensor, (dofs, weights, held) in zip(sensors, readings, strict=True):
        shares = np.concatenate([weights, [each.weight for each in held]])
        signed = shares * np.sign(shares[0])
        places = (*dofs.tolist(), *(each.label for each in held))
        mounts = {str(sensor.node), *(str(name)[:-2] for name in sensor.weights)} & followers
        if len(dofs) > 1 and not mounts:
            mounts = {sensor.name}
        key = (*places, *np.round(signed / np.abs(signed).max(), 9).tolist(), *sorted(mounts))
        if key in seen:
            what = "degree of freedom" if len(dofs) == 1 else "motion"
            message = f"{what} {sensor.words} is measured twice, by {seen[key]} and {sensor.words}"
            draft.error("MD324", message if not sensor.plain else f"{what} {sensor.words} is measured twice", sensor.where,
                        help="give each once")  # fmt: skip
        seen.setdefault(key, sensor.words)
