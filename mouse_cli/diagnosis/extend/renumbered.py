"""What was measured, when the degrees of freedom of the model have other numbers, or some are free that supports held."""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from mouse_cli.model.arrays import Matrix
from mouse_cli.model.frf_test import FrfTest
from mouse_cli.model.held_reading import HeldReading
from mouse_cli.model.modal_test import ModalTest
from mouse_cli.model.recording import Recording

Place = Mapping[str, int]  # of degrees of freedom, by label
_NOWHERE: Place = {}


def moved(test: ModalTest, to: np.ndarray, n: int, place: Place = _NOWHERE) -> ModalTest:
    """The test when degree of freedom i (from 0) of a model has become to[i] of n; place: of those that supports held, by label."""
    sensing = None if test.sensing is None else _moved_weights(test.sensing, to, n)
    free, held = _let_go(test.held, place)
    if free:
        sensing = sensing + _at_supports(free, test.sensors, place, n)
    return replace(test, dofs=to[test.dofs], sensing=sensing, held=held)


def _let_go(held: tuple[HeldReading, ...], place: Place) -> tuple[tuple[HeldReading, ...], ...]:
    """What sensors read where supports held the model before, and where they still hold it."""
    return tuple(h for h in held if h.label in place), tuple(h for h in held if h.label not in place)


def _at_supports(free: tuple[HeldReading, ...], sensors: tuple[str, ...], place: Place, n: int) -> Matrix:
    """Weights (s, n) of degrees of freedom that supports held before, in what `sensors` read."""
    from scipy.sparse import coo_array

    own = [(sensors.index(each.sensor), place[each.label], each.weight) for each in free if each.sensor in sensors]
    row, col, weight = zip(*own, strict=True) if own else ((), (), ())
    return coo_array((np.array(weight, float), (row, col)), shape=(len(sensors), n)).tocsr()


def _moved_weights(weights: Matrix, to: np.ndarray, n: int) -> Matrix:
    """What is read of n degrees of freedom (s, n), or which ones (s,)."""
    if weights.ndim == 1:
        return to[weights]
    from scipy.sparse import coo_array

    stored = coo_array(weights)
    return coo_array((stored.data, (stored.row, to[stored.col])), shape=(weights.shape[0], n)).tocsr()


def moved_functions(test: FrfTest, to: np.ndarray, n: int, place: Place = _NOWHERE) -> FrfTest:
    """Functions when degree of freedom i (from 0) of their model has become to[i] of n; place: see `moved`."""
    outputs, (free, held) = _moved_weights(test.outputs, to, n), _let_go(test.held, place)
    if free:
        outputs = outputs + _at_supports(free, test.output_names, place, n)
    return replace(test, outputs=outputs, inputs=_moved_weights(test.inputs, to, n), held=held)


def moved_channels(recording: Recording, to: np.ndarray, place: Place = _NOWHERE) -> Recording:
    """A recording when degree of freedom i (from 0) of its model has become to[i]; place: see `moved`."""
    own = []
    for c in recording.channels:
        weights, (free, held) = {int(to[i]): w for i, w in c.weights.items()}, _let_go(c.held, place)
        own.append(replace(c, weights=weights | {place[each.label]: each.weight for each in free}, held=held))
    return replace(recording, channels=tuple(own))
