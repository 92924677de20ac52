"""What an update by recordings found."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from mouse_cli._notebook import Shown
from mouse_cli.model.diagnosis import Cause
from mouse_cli.model.problem import Problem
from mouse_cli.model.record_diagnosis import Noise, RecordScore, Surface, Trace
from mouse_cli.model.result import ChiSquareTest


@dataclass(frozen=True)
class RecordUpdate(Shown):
    """The answer of `run` for recordings: the parameters of the deck, and those of its laws, by simulation of its records.

    theta (p,), covariance (p, p): posterior, the covariance times noise_scale, by which the stated variances were multiplied so
    that they explain what is left. laws: with revised sizes. residual: what is left of the records at the posterior; explained:
    whether it may be noise; noise: see Noise. scores, trace: of held-out records, by the prior model and by the revised one;
    surface: of the last law. channels, units, sd (s,): outputs and the accuracy taken for them; inputs, fitted: names.
    """

    problem: Problem
    theta: np.ndarray
    covariance: np.ndarray
    laws: tuple[Cause, ...]
    residual: ChiSquareTest
    noise_scale: float
    explained: bool
    noise: Noise | None
    scores: tuple[RecordScore, ...]
    channels: tuple[str, ...]
    units: tuple[str, ...]
    sd: np.ndarray
    inputs: tuple[str, ...]
    fitted: tuple[str, ...]
    remarks: tuple[str, ...]
    trace: Trace | None = None
    surface: Surface | None = None
    after: ClassVar[str] = "revised"

    @property
    def sd_theta(self) -> np.ndarray:
        """Standard deviations (p,)."""
        return np.sqrt(np.maximum(np.diag(self.covariance), 0.0))

    @property
    def message(self) -> str:
        """The answer in a sentence."""
        if self.explained:
            return "the revised model explains the records"
        return "the revised model does not explain the records: `mouse diagnose` looks for what is missing"

    @property
    def exit_code(self) -> int:
        """0: the model explains the records; 1: it does not."""
        return 0 if self.explained else 1
