"""What a modal test measured: natural frequencies and mode shapes at some degrees of freedom, with their accuracies."""

from dataclasses import dataclass

import numpy as np

from mouse_cli.model.arrays import frozen

SCALES = ("least-squares", "fitted", "unit", "none")


@dataclass(frozen=True)
class ModalTest:
    """m measured modes at s sensors.

    number (m,): system mode number of each measured mode, from 1, rigid-body modes counted.
    frequency_hz, frequency_sd_hz (m,): natural frequencies and standard deviations; NaN: not measured.
    dofs (s,): measured degrees of freedom, from 0. shapes, shape_sd (s, m): components in the units measured; NaN: missing.
    scale: how shapes are brought to the scale of the theory, one of SCALES.
    """

    number: np.ndarray
    frequency_hz: np.ndarray
    frequency_sd_hz: np.ndarray
    dofs: np.ndarray
    shapes: np.ndarray
    shape_sd: np.ndarray
    scale: str = "least-squares"

    def __post_init__(self) -> None:
        m, s = len(self.number), len(self.dofs)
        for name, shape, dtype in (
            ("number", (m,), int),
            ("frequency_hz", (m,), float),
            ("frequency_sd_hz", (m,), float),
            ("dofs", (s,), int),
            ("shapes", (s, m), float),
            ("shape_sd", (s, m), float),
        ):
            object.__setattr__(self, name, frozen(getattr(self, name), shape, name, dtype))

    @property
    def m(self) -> int:
        """Number of measured modes (NM)."""
        return len(self.number)

    @property
    def s(self) -> int:
        """Number of measured degrees of freedom (IROW)."""
        return len(self.dofs)
