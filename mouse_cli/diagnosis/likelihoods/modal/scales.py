"""By what the sizes of causes are measured: mass of the structure, its lowest measured mode, its bars."""

import numpy as np

from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.dynamics.frequency import eigenvalue

BODY = np.array([1e-3, 2.0])  # masses that a body missing from the model may have, over that of the model


def total_mass(model: Reduced) -> float:
    """Mass (kg) of the structure."""
    return model.total_mass


def lowest(model: Reduced) -> float:
    """Eigenvalue of the lowest measured frequency, (rad/s)^2."""
    return float(eigenvalue(np.nanmin(model.data.test.frequency_hz)))


def highest(model: Reduced) -> float:
    """Eigenvalue of the highest measured frequency, (rad/s)^2."""
    return float(eigenvalue(np.nanmax(model.data.test.frequency_hz)))


def span(model: Reduced) -> float:
    """Largest distance between nodes along an axis, m; infinite without geometry."""
    at = model.problem.structure.geometry
    return float(np.ptp(at.coordinates, axis=0).max()) if at is not None else float("inf")
