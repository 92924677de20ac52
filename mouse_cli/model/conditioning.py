"""How errors of data and of sensitivities reach a least-squares answer."""

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Conditioning:
    """Bounds for the answer z of min |A z - b|, A = R^-1/2 T L and b as weighed, all in prior standard deviations.

    with_prior: the prior stands beneath A as k further data. condition: kappa, largest over smallest singular value of A.
    data, sensitivities: most that |dz|/|z| can be for |db|/|b| and for |dA|/|A|, to first order, as multiples of these; inf where
    the answer is the prior itself, z = 0. weakest (p,): the combination of the properties that is known least, each in its prior
    standard deviations. error: |dA|/|A| that the computation of T is estimated to have; None where it was not.
    """

    condition: float
    data: float
    sensitivities: float
    weakest: np.ndarray
    with_prior: bool
    error: float | None = None

    @property
    def shift(self) -> float | None:
        """Most that |dz|/|z| can be for the error that the sensitivities are estimated to have."""
        return None if self.error is None else self.sensitivities * self.error
