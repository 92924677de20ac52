"""What a run found; reports read it and compute nothing."""

from dataclasses import dataclass, field

import numpy as np

from mouse_cli._errors import Diagnostic
from mouse_cli._notebook import Shown
from mouse_cli.model.arrays import Matrix
from mouse_cli.model.conditioning import Conditioning
from mouse_cli.model.frf_fit import FrfFit
from mouse_cli.model.problem import Problem


@dataclass(frozen=True)
class ChiSquareTest:
    """A test of the model form: `chi2` on `dof` degrees of freedom would be exceeded with probability `p`."""

    name: str
    chi2: float
    dof: int
    p: float

    @property
    def rejects(self) -> bool:
        """Whether so large a value would come by chance less than once in a thousand."""
        return self.dof > 0 and self.p < REJECT


REJECT = 1e-3  # gate of the model-form tests
DOUBT = 0.05  # share of the posterior that another mode may hold at most beside an answer that is to be used
UNTRUSTED, NO_ANSWER = 1, 5  # exit codes of runs whose answer is not to be used, and of those that broke off


@dataclass(frozen=True)
class Status:
    """How a run ended: `key`, one sentence that says it, one that says what to do; `exit_code` of the command.

    answered: whether there are values of the parameters to report, trusted or not.
    """

    key: str
    sentence: str
    advice: str = ""
    exit_code: int = 0
    answered: bool = True


@dataclass(frozen=True)
class Cycle:
    """One pass of the outer loop: values (p,) of the parameters after it, and how the data then stand.

    chi2 = r'R^-1 r; exceedances of `allowed`; cost: chi2 plus the prior's share; damping of the accepted step.
    """

    index: int
    theta: np.ndarray
    chi2: float
    exceedances: int
    allowed: int
    cost: float
    damping: float = 0.0


@dataclass(frozen=True)
class Snapshot:
    """The model at given values theta (p,).

    K, M; eigenvalues (k,) and shapes (n, k), all modes of a dense model; modes (m,) from 0: which of them was paired with
    each measured one; model_shapes (s, m) at the scale of the test; predicted (q,) data and sd_predicted (q,) from the
    covariance of theta; mac (m,).
    """

    theta: np.ndarray
    K: Matrix
    M: Matrix
    eigenvalues: np.ndarray
    shapes: np.ndarray
    modes: np.ndarray
    model_shapes: np.ndarray
    predicted: np.ndarray
    sd_predicted: np.ndarray
    mac: np.ndarray


@dataclass(frozen=True)
class Alternative:
    """Another mode of the posterior: values theta (p,) with their sd (p,), J there, and its share of the posterior."""

    theta: np.ndarray
    sd: np.ndarray
    cost: float
    share: float


@dataclass(frozen=True)
class Alternatives:
    """Other modes of the posterior, the highest first, when the answer itself has `share`.

    deciding: a measurement at which the two highest differ most: (number of the measured mode, degree of freedom from 0, component
    of its shape at the answer, at the other), the largest component being 1; None where none tells them apart.
    """

    share: float
    others: tuple[Alternative, ...]
    deciding: tuple[int, int, float, float] | None = None

    @property
    def doubtful(self) -> bool:
        """Whether another one holds more of the posterior than may be left unsaid."""
        return any(each.share > DOUBT for each in self.others)


@dataclass(frozen=True)
class Result(Shown):
    """The answer of `run`.

    y, sd, labels (q,): the data at the scale of the theory; test_shapes (s, m) and shape_factor (m,) likewise.
    covariance (p, p; None for many parameters, see RunOptions) and sd_theta (p,) of the revised parameters, in their units;
    at_limit (p,).
    B (q, e), T (q, p): partials at the revised model, only when asked for. innovation: before the cycles; residual and
    prior_shift: after them. partials_error: estimated relative error of the final T; 0 where it is rounding alone. frf, held_frf:
    before and after, one for each measurement of frequency response functions that was fitted, or held out. conditioning: None for
    problems too large for it. alternatives: other values that fit as well, None where none were found or sought.

    >>> import mouse_cli
    >>> result = mouse_cli.run(mouse_cli.read_deck("decks/ground_spring.yaml"))
    >>> result.status.key, result.model_form, result.exit_code
    ('converged', 'rejected', 1)
    """

    problem: Problem
    status: Status
    cycles: tuple[Cycle, ...]
    prior: Snapshot
    revised: Snapshot
    y: np.ndarray
    sd: np.ndarray
    labels: tuple[str, ...]
    test_shapes: np.ndarray
    test_shape_sd: np.ndarray
    shape_factor: np.ndarray
    covariance: np.ndarray | None
    sd_theta: np.ndarray
    at_limit: np.ndarray
    innovation: ChiSquareTest
    residual: ChiSquareTest
    prior_shift: ChiSquareTest
    rigid_modes: int
    z: float
    allowed: int
    exceeding: np.ndarray
    warnings: tuple[Diagnostic, ...] = ()
    B: np.ndarray | None = None
    T: np.ndarray | None = None
    versions: dict[str, str] = field(default_factory=dict)
    partials_error: float | None = None
    frf: tuple[FrfFit, ...] = ()
    held_frf: tuple[FrfFit, ...] = ()
    conditioning: Conditioning | None = None
    alternatives: Alternatives | None = None

    def interval(self, i: int) -> tuple[float, float]:
        """Limits of property i with the confidence of the run, by its logarithm where that is what was estimated."""
        value, width = float(self.revised.theta[i]), float(self.z * self.sd_theta[i])
        if self.problem.parameters[i].transform == "log" and value > 0:
            return value * float(np.exp(-width / value)), value * float(np.exp(width / value))
        return value - width, value + width

    @property
    def rejected(self) -> bool:
        """Whether the data contradict the form of the model, as far as the tests after the cycles can tell."""
        return self.residual.rejects or self.prior_shift.rejects

    @property
    def model_form(self) -> str:
        """`rejected`, `accepted`, or `untested`: no answer to judge by, or no datum more than properties."""
        if self.rejected:
            return "rejected"
        return "accepted" if self.residual.dof > 0 and self.status.exit_code < NO_ANSWER else "untested"

    @property
    def exit_code(self) -> int:
        """0: converged and the model explains the data; 1: do not trust it; 5: no answer."""
        ambiguous = self.alternatives is not None and self.alternatives.doubtful
        return self.status.exit_code or int(self.rejected or ambiguous)


@dataclass(frozen=True)
class Forecast(Shown):
    """Answer of `modes`: natural frequencies and shapes of the prior model with the uncertainty the prior gives them.

    frequencies_hz, sd_hz (k,); shapes, shape_sd (n, k), mass-normalised, largest component positive. damped: of a model that has
    damping. root_hz (k, r): derivatives of the frequencies by what the prior leaves uncertain, in its units, so that their
    covariance is root root'.
    """

    problem: Problem
    frequencies_hz: np.ndarray
    sd_hz: np.ndarray
    shapes: np.ndarray
    shape_sd: np.ndarray
    rigid_modes: int
    damped: "DampedModes | None" = None
    root_hz: np.ndarray | None = None


@dataclass(frozen=True)
class DampedModes:
    """Modes of a damped model, by |s|: frequencies_hz |s| / 2 pi, damping ratios with sd, and complexity of shapes, all (k,).

    shapes (n, k): complex. error: estimated, of the poles, relative.
    """

    frequencies_hz: np.ndarray
    damping: np.ndarray
    damping_sd: np.ndarray
    complexity: np.ndarray
    shapes: np.ndarray
    error: float
