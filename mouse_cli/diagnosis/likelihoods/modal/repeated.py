"""Measured modes that have one shape at several frequencies, as no sensor sees how they differ, or each the shape of the other."""

import numpy as np

from mouse_cli.diagnosis.search.fit import Fit
from mouse_cli.dynamics.correlation import mac

_ALIKE, _SAME, _OTHER = 0.95, 0.98, 0.8  # MAC of two measured modes of one shape, and of one mode; of those of the model, at most
SENSORS = 5  # that shapes were measured at, at least: fewer hardly tell them apart
_THEIRS, _OWN = 0.8, 0.5  # MAC with the other mode, at least, and with its own, at most, of two whose shapes are exchanged
_APART = 0.02  # of ln f, up to which two modes may be a double one, of which any two shapes are measured


def repeated(one: Fit, twice: bool = False) -> list[tuple[int, int]]:
    """Pairs of measured modes, by their places in the test, that have one shape each, where a fit has no such two modes.

    twice: those at about one frequency, which are one mode that was identified twice.
    """
    test, at = one.data.test, one.point
    have = np.isfinite(test.shapes).astype(int)
    alike = (mac(test.shapes, test.shapes) > (_SAME if twice else _ALIKE)) & (have.T @ have >= SENSORS)
    own = at.measured(at.seen)
    with np.errstate(invalid="ignore"):
        apart = np.abs(np.subtract.outer(np.log(test.frequency_hz), np.log(test.frequency_hz))) > _APART
    found = np.argwhere(np.triu(alike & (apart != twice) & (mac(own, own) < _OTHER), 1))
    several = _several(one) if len(found) else np.zeros(test.m, bool)
    return [(int(i), int(j)) for i, j in found if not several[[i, j]].all()]


def _several(one: Fit) -> np.ndarray:
    """Mask (m,) of measured modes that two modes of a fit or more look like, whether they were measured or not."""
    low = one.point.eigenvalues <= 4 * one.point.eigenvalues[one.point.modes].max()
    return (np.nan_to_num(mac(one.data.test.shapes, one.point.seen[:, low])) > _OTHER).sum(axis=1) > 1


def exchanged(one: Fit) -> list[tuple[int, int]]:
    """Pairs of measured modes, by their places in the test, each of which has the shape of the other one's partner in a fit."""
    test, at = one.data.test, one.point
    likeness = np.nan_to_num(mac(test.shapes, at.measured(at.seen)))
    theirs, own = likeness > _THEIRS, likeness.diagonal() < _OWN
    found = np.argwhere(np.triu(theirs & theirs.T & own & own[:, None], 1))
    return [(int(i), int(j)) for i, j in found]
