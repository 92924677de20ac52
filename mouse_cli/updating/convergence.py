"""The report's convergence test: how many data may lie outside their confidence limits (O-2, O-3)."""

from dataclasses import dataclass

import numpy as np

Z = {99: 2.576, 95: 1.960, 90: 1.645}  # two-sided normal quantiles, by confidence level in per cent
_ROUNDING = 1e-9


@dataclass(frozen=True)
class ExceedanceTest:
    """At `confidence` per cent a share alpha of the data is expected outside z sd; more than that: not converged.

    rule `ratio`: exceedances <= alpha (data - exceedances), as the report's O-2 words it; `fraction`: <= alpha data.
    """

    confidence: int
    rule: str

    @property
    def z(self) -> float:
        """Half width of the confidence interval in standard deviations."""
        return Z[self.confidence]

    def exceeding(self, residual: np.ndarray, sd: np.ndarray) -> np.ndarray:
        """Mask (q,) of the data outside their limits."""
        return np.abs(residual) > self.z * sd

    def allowed(self, q: int) -> int:
        """Most exceedances among `q` data that still count as converged.

        >>> ExceedanceTest(95, "ratio").allowed(20), ExceedanceTest(95, "fraction").allowed(20)
        (0, 1)
        """
        alpha = 1 - self.confidence / 100
        share = alpha / (1 + alpha) if self.rule == "ratio" else alpha
        return int(np.floor(share * q + _ROUNDING))
