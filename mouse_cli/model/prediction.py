"""How well a model predicts data that no fit has seen."""

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Score:
    """How well data that no fit has seen were predicted; rms_shape_error: at sensors held out, over the largest component.

    p: probability of a larger misfit than theirs, were the model as accurate as it is said to be.
    """

    rms_frequency_error: float
    log_predictive_density: float
    covered: float
    frequencies_hz: np.ndarray
    sd_hz: np.ndarray
    mac: np.ndarray
    rms_shape_error: float = float("nan")
    p: float = float("nan")


BY_DECK, BY_MODE = "held out by the deck", "each mode from the others"
REFUTED = 1e-3  # p-value of data below which they refute a model
INTERVAL = 0.9  # probability of each interval of a prediction


@dataclass(frozen=True)
class HeldOut:
    """Data kept from every fit, BY_DECK or BY_MODE. labels, measured_hz (h,); baseline, revised: how either model predicts them."""

    kind: str
    labels: tuple[str, ...]
    measured_hz: np.ndarray
    baseline: Score
    revised: Score | None

    @property
    def p(self) -> float:
        """p-value of the revised model: of the misfit of what the deck holds out, of how few modes lie within their intervals as
        others predict them; 1 without such a model.
        """
        if self.revised is None:
            return 1.0
        return self.revised.p if self.kind == BY_DECK else self.within

    @property
    def within(self) -> float:
        """Probability of so few frequencies within the 90 % intervals of the revised model by chance alone, a binomial one."""
        from scipy.special import bdtr

        count = int(np.isfinite(self.measured_hz).sum())
        return float(bdtr(round(count * self.revised.covered), count, INTERVAL)) if count else 1.0

    @property
    def refuted(self) -> bool:
        """Whether data that no fit has seen refute the revised model, however much better than the other it predicts them."""
        return self.p < REFUTED
