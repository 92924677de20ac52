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


@dataclass(frozen=True)
class HeldOut:
    """Data kept from every fit, BY_DECK or BY_MODE. labels, measured_hz (h,); baseline, revised: how either model predicts them."""

    kind: str
    labels: tuple[str, ...]
    measured_hz: np.ndarray
    baseline: Score
    revised: Score | None

    @property
    def refuted(self) -> bool:
        """Whether what the deck holds out refutes the revised model, however much better than the other it predicts that."""
        return self.kind == BY_DECK and self.revised is not None and self.revised.p < REFUTED
