"""What may be revised, and what was believed of it before the test."""

from dataclasses import dataclass
from math import inf

import numpy as np

from mouse_cli._span import Span
from mouse_cli.model.arrays import freeze

TRANSFORMS = ("identity", "log")


@dataclass(frozen=True)
class Parameter:
    """One physical property (a column of A). Card decks punch no values: there `nominal` is 0 and theta is a change.

    `lower` and `upper` restrain the value, in the unit of the property. `transform: log` keeps it positive.
    """

    name: str
    sd: float
    nominal: float = 0.0
    unit: str = ""
    lower: float = -inf
    upper: float = inf
    transform: str = "identity"
    span: Span | None = None

    @property
    def variance(self) -> float:
        """sd^2 as numpy rounds it; Python's ** may be off by the last bit."""
        return self.sd * self.sd


@dataclass(frozen=True)
class Gaussian:
    """Normal distribution of p values: mean (p,), cov (p, p) or, when uncorrelated, its diagonal (p,)."""

    mean: np.ndarray
    cov: np.ndarray

    def __post_init__(self) -> None:
        p = len(self.mean)
        freeze(self, mean=(p,), cov=(p,) if np.ndim(self.cov) == 1 else (p, p))

    @property
    def sd(self) -> np.ndarray:
        """Standard deviations (p,)."""
        return np.sqrt(self.cov if self.cov.ndim == 1 else np.diag(self.cov))

    def dense(self) -> np.ndarray:
        """Covariance as a full (p, p) matrix."""
        return np.diag(self.cov) if self.cov.ndim == 1 else self.cov
