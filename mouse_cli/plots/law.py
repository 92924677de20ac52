"""The force law that the data imply at the place of the cause, and the law of the cause."""

from typing import Any

import numpy as np

from mouse_cli.model.diagnosis import Diagnosis
from mouse_cli.plots import AFTER, Plot


def draw(found: Diagnosis, axes: Any) -> bool:
    """Stiffness over frequency: level for a spring, falling with its square for a mass, a pole for an oscillator."""
    law = found.law
    if law is None:
        return False
    known = np.isfinite(law.stiffness) & np.isfinite(law.sd)
    if not known.any():
        return False
    hz = law.frequency_hz[known]
    axes.errorbar(
        hz, law.stiffness[known], law.sd[known], fmt="o", color="black", capsize=3, label="implied by the data"
    )
    axes.plot(
        hz, law.fitted[known], "_", markersize=24, markeredgewidth=2, color=AFTER, label=f"{found.best.physics}, fitted"
    )
    axes.axhline(0, color="black", linewidth=0.8)
    size = max(np.abs(law.fitted[known]).max(), np.median(np.abs(law.stiffness[known])))
    axes.set_ylim(*_limits(law.stiffness[known], law.fitted[known], 4 * size))
    axes.set_xlabel("frequency, Hz")
    axes.set_ylabel(f"dynamic stiffness, {law.unit}")
    axes.legend()
    return True


def _limits(stiffness: np.ndarray, fitted: np.ndarray, most: float) -> tuple[float, float]:
    """A range that shows the laws, and not a single value without worth."""
    both = np.clip(np.concatenate([stiffness, fitted, [0.0]]), -most, most)
    margin = 0.15 * np.ptp(both)
    return float(both.min() - margin), float(both.max() + margin)


PLOT = Plot("law", 30, "Force law at the site of the mechanism", draw)
