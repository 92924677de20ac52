"""What a modal test measured: natural frequencies and mode shapes at some degrees of freedom, with their accuracies."""

from dataclasses import dataclass, replace

import numpy as np

from mouse_cli.model.arrays import Matrix, freeze
from mouse_cli.model.held_reading import HeldReading

SCALES = ("least-squares", "fitted", "unit", "none")


@dataclass(frozen=True)
class ModalTest:
    """m measured modes at s sensors.

    number (m,): system mode number of each measured mode, from 1, rigid-body modes counted.
    frequency_hz, frequency_sd_hz (m,): natural frequencies and standard deviations; NaN: not measured.
    dofs (s,): measured degrees of freedom, from 0. shapes, shape_sd (s, m): components in the units measured; NaN: missing.
    scale: how shapes are brought to the scale of the theory, one of SCALES. sensing (s, n), sparse: what each sensor reads, for
    sensors that are mounted backwards, in a direction between the axes, or between nodes; then dofs are the nearest ones. None:
    each sensor reads its degree of freedom. sensors: their names, when those of the degrees of freedom do not serve. held:
    what they read besides where supports hold the model, 0 in it, see `HeldReading`.
    """

    number: np.ndarray
    frequency_hz: np.ndarray
    frequency_sd_hz: np.ndarray
    dofs: np.ndarray
    shapes: np.ndarray
    shape_sd: np.ndarray
    scale: str = "least-squares"
    sensing: Matrix | None = None
    sensors: tuple[str, ...] = ()
    held: tuple[HeldReading, ...] = ()

    def __post_init__(self) -> None:
        m, s = len(self.number), len(self.dofs)
        freeze(self, int, number=(m,), dofs=(s,))
        freeze(self, frequency_hz=(m,), frequency_sd_hz=(m,), shapes=(s, m), shape_sd=(s, m))

    @property
    def m(self) -> int:
        """Number of measured modes (NM)."""
        return len(self.number)

    @property
    def s(self) -> int:
        """Number of measured degrees of freedom (IROW)."""
        return len(self.dofs)

    @property
    def measured_at(self) -> Matrix:
        """What the sensors read: degrees of freedom (s,), or weights (s, n) where that is not enough."""
        return self.dofs if self.sensing is None else self.sensing

    def read(self, shapes: np.ndarray) -> np.ndarray:
        """What the sensors read (s, k) of `shapes` (n, k)."""
        return shapes[self.dofs] if self.sensing is None else self.sensing @ shapes


def restricted(test: ModalTest, modes: np.ndarray) -> ModalTest:
    """The test with the modes of the mask `modes` (m,) alone."""
    return replace(
        test,
        number=test.number[modes],
        frequency_hz=test.frequency_hz[modes],
        frequency_sd_hz=test.frequency_sd_hz[modes],
        shapes=test.shapes[:, modes],
        shape_sd=test.shape_sd[:, modes],
    )
