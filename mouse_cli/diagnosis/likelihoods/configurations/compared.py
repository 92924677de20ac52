"""Tests of one model before and after something changed, each beside the other: what its theory errs is in both.

Of a mode that is y before and z after, with standard deviations s and t, (ln f_z - ln f_y) / sqrt(s^2 + t^2), and for shapes
(z - a y) / sqrt(t^2 + a^2 s^2) with the scale a that leaves least, are noise where nothing has changed, whatever the model errs.
"""

from itertools import product

import numpy as np

from mouse_cli.diagnosis.likelihoods.configurations.model import Arranged
from mouse_cli.dynamics.correlation import pair
from mouse_cli.model.arrangements import Compared
from mouse_cli.model.modal_test import ModalTest
from mouse_cli.updating.chi_square import upper_tail

_SETTLED = 4  # times that the scale of a shape is found again, for errors of both that follow it
_WAYS = 3  # p-values of one pair of tests: of all data, of frequencies, and of what differs most


def compared(base: Arranged) -> Compared | None:
    """The two tests that differ most; None where one that changed has none of the same sensors and modes beside it."""
    having, tests = base.having, [part.data.test for part in base.parts]
    pairs = [each for members in base.errors.alike for each in product(members, members) if having[each[0]] < having[each[1]]]
    if {after for _, after in pairs} != set(np.flatnonzero(having).tolist()):
        return None
    found = [between(tests[before], tests[after]) for before, after in pairs]
    least = None if None in found else min(found, key=lambda each: each.p)
    return least and Compared(least.chi2, least.dof, min(1.0, len(found) * least.p))


def between(before: ModalTest, after: ModalTest) -> Compared | None:
    """How two tests of one structure differ; None where they have other sensors, or other numbers of modes."""
    seen = before.measured_at, after.measured_at
    if before.m != after.m or seen[0].shape != seen[1].shape or abs(seen[0] - seen[1]).sum() > 0:
        return None
    which = pair(after.shapes, after.frequency_hz, before.shapes, before.frequency_hz)
    off = np.log(after.frequency_hz / before.frequency_hz[which])
    sd = np.hypot(after.frequency_sd_hz / after.frequency_hz, (before.frequency_sd_hz / before.frequency_hz)[which])
    moved = (off / sd)[np.isfinite(off)] ** 2
    turned, scales = _of_shapes(before.shapes[:, which], before.shape_sd[:, which], after)
    every = np.concatenate([moved, turned])
    if not len(every):
        return None
    chi2, dof = float(every.sum()), len(every) - scales
    ways = upper_tail(chi2, dof), upper_tail(float(moved.sum()), len(moved)), len(every) * upper_tail(float(every.max()), 1)
    return Compared(chi2, dof, min(1.0, _WAYS * min(ways)))


def _of_shapes(shapes: np.ndarray, sd: np.ndarray, after: ModalTest) -> tuple[np.ndarray, int]:
    """Squares (q,) of what the shapes (s, m) before leave of those after, each at its best scale; and the number of scales."""
    have = np.isfinite(shapes) & np.isfinite(after.shapes)
    y, z = (np.where(have, each, 0.0) for each in (shapes, after.shapes))
    s, t = (np.where(have, each, 1.0) for each in (sd, after.shape_sd))
    a, free = np.ones(after.m), after.scale != "none"
    for _ in range(_SETTLED if free else 1):
        weight = 1 / (t**2 + a**2 * s**2)
        along, size = (weight * y * z).sum(axis=0), (weight * y**2).sum(axis=0)
        fitted = np.divide(along, size, out=np.zeros(after.m), where=size > 0)
        a = fitted if free else np.where(along < 0, -1.0, 1.0)
    left = (z - a * y) ** 2 / (t**2 + a**2 * s**2)
    return left[have], int(have.any(axis=0).sum()) if free else 0
