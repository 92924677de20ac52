"""Damping given by the modes of a model."""

from dataclasses import dataclass

import numpy as np

from mouse_cli.model.arrays import freeze


@dataclass(frozen=True)
class ModalDamping:
    """Damping ratios (m,) of the elastic modes from the lowest on, the last of them of all modes above too.

    sd: prior standard deviation of each, as a share of it; 0: they are held.
    """

    ratio: np.ndarray
    sd: float = 0.0

    def __post_init__(self) -> None:
        freeze(self, ratio=(len(self.ratio),))
