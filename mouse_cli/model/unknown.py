"""A parameter of a cause or of a law, before any test."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np


@dataclass(frozen=True)
class Unknown:
    """A parameter, uniform before the test over its range, or its logarithm is (`log`); but for `at_end`, a share of its prior at
    the upper end: a part that has lost something may be gone.
    """

    name: str
    unit: str
    lower: float
    upper: float
    log: bool = True
    at_end: float = 0.0

    @cached_property
    def bounds(self) -> tuple[float, float]:
        """Range of the coordinate: the logarithm or the value."""
        return (float(np.log(self.lower)), float(np.log(self.upper))) if self.log else (self.lower, self.upper)

    def value(self, coordinate: float) -> float:
        """The value that a coordinate stands for."""
        return float(np.exp(coordinate)) if self.log else float(coordinate)

    @property
    def key(self) -> str:
        """How a deck calls it.

        >>> Unknown("1 + chi", "1", 0.1, 1).key, Unknown("slip force", "N", 1, 2).key
        ('one_plus_chi', 'slip_force')
        """
        return self.name.replace("1 + ", "one plus ").replace("'", "").replace(" ", "_")
