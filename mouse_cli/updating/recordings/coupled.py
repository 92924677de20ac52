"""Channels that lose what is slow: the AC coupling of a conditioner, a high-pass of first order at a corner c, y = s / (s + c) x.

What they should have read is linear in it, x = y + c times the integral of y, so that a first look has c in closed form.
"""

from dataclasses import dataclass

import numpy as np

from mouse_cli.updating.recordings.calibration import as_read
from mouse_cli.updating.recordings.regression import Regression

_HIGHEST = 0.5  # of the highest frequency of the record, up to which a corner is one of what is slow


@dataclass(frozen=True)
class Coupled:
    """Outputs (numbers) that lose what is slow; corner, Hz; left: chi2 with that."""

    outputs: tuple[int, ...]
    corner_hz: float
    left: float


def coupled(at: Regression) -> Coupled | None:
    """The corner, of all outputs alike or of one, that leaves least; None where none leaves less."""
    s, count = at.spectrum, at.spectrum.series.measured.shape[1]
    over = np.divide(1, 1j * s.w, out=np.zeros(len(s.w), complex), where=s.w > 0)
    integral = s.history(s.line(as_read(s)) * over[:, None])
    found = (_corner(at, integral, which) for which in (tuple(range(count)), *((j,) for j in range(count) if count > 1)))
    return min((one for one in found if one is not None), key=lambda one: one.left, default=None)


def _corner(at: Regression, integral: np.ndarray, which: tuple[int, ...]) -> Coupled | None:
    """That of some outputs; None where they would have to lose a negative share, or all."""
    column = at.stacked(np.where(np.isin(np.arange(integral.shape[1]), which), integral, 0.0))
    free = at.projected(column)
    size = float(free @ free)
    c = -float(free @ at.target) / size if size > 0 else 0.0
    if not 0 < c < _HIGHEST * at.spectrum.w[-1]:
        return None
    return Coupled(which, c / (2 * np.pi), at.begin(-c * column, np.zeros(0))[1])
