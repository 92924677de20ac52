"""Measured modes that have one shape at several frequencies: the motion in which they differ is seen by no sensor."""

import numpy as np

from mouse_cli.diagnosis.search.fit import Fit
from mouse_cli.dynamics.correlation import mac

_ALIKE, _OTHER = 0.95, 0.8  # MAC of two measured modes from which on they are one shape; of those of the model, at most
SENSORS = 5  # that shapes were measured at, at least: fewer hardly tell them apart
_APART = 0.02  # of ln f, up to which two modes may be a double one, of which any two shapes are measured


def repeated(one: Fit) -> list[tuple[int, int]]:
    """Pairs of measured modes, by their places in the test, that have one shape each, where a fit has no such two modes."""
    test, at = one.data.test, one.point
    have = np.isfinite(test.shapes).astype(int)
    alike = (mac(test.shapes, test.shapes) > _ALIKE) & (have.T @ have >= SENSORS)
    own = at.measured(at.seen)
    with np.errstate(invalid="ignore"):
        apart = np.abs(np.subtract.outer(np.log(test.frequency_hz), np.log(test.frequency_hz))) > _APART
    found = np.argwhere(np.triu(alike & apart & (mac(own, own) < _OTHER), 1))
    return [(int(i), int(j)) for i, j in found]
