"""By what the sizes of causes are measured: mass of the structure, its lowest measured mode, its bars."""

import numpy as np

from mouse_cli.diagnosis.reduced import Reduced
from mouse_cli.dynamics.frequency import eigenvalue


def total_mass(model: Reduced) -> float:
    """Mass that moves when the structure translates; without geometry the sum of the diagonal."""
    _, M = model.assembly.matrices(model.theta)
    at = model.problem.structure.geometry
    if at is None:
        return float(M.diagonal().sum())
    most = 0.0
    for d in range(3):
        rigid = ((at.direction == d) & (at.node >= 0)).astype(float)
        most = max(most, float(rigid @ (M @ rigid)))
    return most or float(M.diagonal().sum())


def lowest(model: Reduced) -> float:
    """Eigenvalue of the lowest measured frequency, (rad/s)^2."""
    return float(eigenvalue(np.nanmin(model.data.test.frequency_hz)))


def highest(model: Reduced) -> float:
    """Eigenvalue of the highest measured frequency, (rad/s)^2."""
    return float(eigenvalue(np.nanmax(model.data.test.frequency_hz)))
