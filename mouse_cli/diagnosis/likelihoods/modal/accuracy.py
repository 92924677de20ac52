"""Is the test as accurate as its deck says? Errors of all sensors, or of all frequencies, weighed beside every explanation.

Let the readings be off by G g, g ~ N(0, tau^2 I), each g an error of one sensor in all modes, or of one frequency. With the
residual r of a fit, the derivatives T of what it predicts, A = T'T + its prior, and B = G'G - G'T A^-1 T'G, what its parameters
cannot follow,

    ln Z(tau) - ln Z(0) = 1/2 b'(B + I/tau^2)^-1 b - 1/2 ln |I + tau^2 B|,     b = G'(r - T A^-1 (T'r - prior))

to first order in g, which is enough for errors of some per cent. B = U diag(beta) U' gives it for every tau at once.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from mouse_cli.diagnosis.effects.sensors import sliding
from mouse_cli.diagnosis.likelihoods.modal.data import Data
from mouse_cli.diagnosis.noise import log_density
from mouse_cli.diagnosis.search.fit import Fit

_PROBABLE = 0.03  # of each kind of error, before the test
_NODES = 9  # sizes tau that are weighed, evenly spaced in their logarithm


@dataclass(frozen=True)
class Error:
    """A kind of error of a test. readings(fit): G (q, d), whitened, by unit errors; smallest, largest: of its sd tau."""

    key: str
    readings: Callable[[Fit], np.ndarray]
    smallest: float
    largest: float

    @property
    def sizes(self) -> np.ndarray:
        """Values (t,) of tau that are weighed."""
        return np.geomspace(self.smallest, self.largest, _NODES)


@dataclass(frozen=True)
class Weighed:
    """A fit beside one kind of error, None: the accuracies as stated. gained, misfit (t,): of ln Z, and left, at each tau."""

    error: Error | None
    gained: np.ndarray
    misfit: np.ndarray

    def log_weight(self, dof: float) -> float:
        """ln of what the evidence of the fit is multiplied by: the prior of the error, and noise larger than stated, integrated."""
        prior = _PROBABLE if self.error else 1 - len(ERRORS) * _PROBABLE
        more = self.gained + 0.5 * self.misfit + log_density(self.misfit, dof)
        return float(np.logaddexp.reduce(more) + np.log(prior / len(self.gained)))

    @property
    def size(self) -> float:
        """The most probable tau; 0 without an error."""
        return float(self.error.sizes[np.argmax(self.gained)]) if self.error else 0.0


@dataclass(frozen=True)
class Doubt:
    """An error of the test, how probable it is whatever the cause, and its most probable sd."""

    key: str
    probability: float
    size: float


def doubts(parts: list[tuple[float, tuple[Weighed, ...], np.ndarray]]) -> tuple[Doubt, ...]:
    """The most probable first, from probability of a fit, its ways, and their shares (w,) in it."""
    total: dict[str, float] = {}
    leading: dict[str, tuple[float, float]] = {}
    for p, own, shares in parts:
        for way, share in zip(own, shares, strict=True):
            if way.error:
                key, weight = way.error.key, float(p * share)
                total[key] = total.get(key, 0.0) + weight
                leading[key] = max(leading.get(key, (-1.0, 0.0)), (weight, way.size))
    return tuple(Doubt(key, total[key], leading[key][1]) for key in sorted(total, key=lambda key: -total[key]))


def ways(one: Fit) -> tuple[Weighed, ...]:
    """The fit with the accuracies as stated, and beside each kind of error that has a meaning for its test, if that is modal."""
    stated = Weighed(None, np.zeros(1), np.array([one.misfit]))
    if not isinstance(one.data, Data):
        return (stated,)
    descent = _descent(one)
    return (stated, *(found for error in ERRORS if (found := _weighed(one, error, *descent)) is not None))


def _weighed(one: Fit, error: Error, T: np.ndarray, A: np.ndarray, slope: np.ndarray) -> Weighed | None:
    G = error.readings(one)
    if not G.any():
        return None
    along = T.T @ G
    followed = np.linalg.solve(A, np.column_stack([along, slope]))
    beta, U = np.linalg.eigh(G.T @ G - along.T @ followed[:, :-1])
    beta, b = np.maximum(beta, 0.0), U.T @ (G.T @ one.point.residual - along.T @ followed[:, -1])
    tau2 = error.sizes[:, None] ** 2
    less = (b**2 * tau2 / (1 + tau2 * beta)).sum(axis=1)
    return Weighed(error, 0.5 * (less - np.log1p(tau2 * beta).sum(axis=1)), np.maximum(one.misfit - less, 0.0))


def _descent(one: Fit) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """T (q, f), A (f, f) and the slope (f,) of the misfit along x, but for coordinates at a limit that they would leave."""
    model, x, T = one.model, one.point.x, one.model.jacobian(one.point)
    slope = T.T @ one.point.residual - np.where(np.arange(len(x)) < model.k, x, 0.0)
    low, high = np.vstack([np.tile([-np.inf, np.inf], (model.k, 1)), model.bounds]).T
    free = ~(((x <= low) & (slope < 0)) | ((x >= high) & (slope > 0)))
    return T[:, free], np.linalg.inv(one.covariance)[np.ix_(free, free)], slope[free]


def scatter(one: Fit) -> tuple[float, float]:
    """By what the sd of frequencies, and of shapes, are to be multiplied for what a fit leaves of either; NaN without data."""
    data, r = one.model.base.data, one.point.residual
    T, A, _ = _descent(one)
    free = 1 - np.einsum("qf,fq->q", T, np.linalg.solve(A, T.T))
    own = np.arange(len(r)) < data.has_frequency.sum()
    profiled = data.has_shape.any(axis=0).sum() if data.scaled else 0
    parts = ((own, 0), (~own, profiled))
    left = [(float((r[rows] ** 2).sum()), float(free[rows].sum()) - scales) for rows, scales in parts]
    return tuple(float(np.sqrt(size / dof)) if dof > 0.5 else float("nan") for size, dof in left)


def _gains(one: Fit) -> np.ndarray:
    """Every sensor reads a multiple of what it should."""
    return _of_sensors(one, one.point.measured(one.point.seen))


def _places(one: Fit) -> np.ndarray:
    """Every sensor stands a share of the length of its row of bars away from where the deck has it."""
    base, at = one.model.base, one.point
    return _of_sensors(one, sliding(base) @ at.measured(at.X[: base.r]))


def _of_sensors(one: Fit, moved: np.ndarray) -> np.ndarray:
    """G (q, s) of errors that move what sensors read by `moved` (s, m); in one mode alone they are noise, and left out."""
    at, data, each = one.point, one.model.base.data, np.arange(len(moved))
    apart = np.zeros((*moved.shape, len(each)))
    apart[each, :, each] = moved
    apart[data.has_shape.sum(axis=1) < 2] = 0.0
    still = np.zeros((len(at.modes), len(each)))
    found = data.jacobian(at.eigenvalues[at.modes], at.measured(at.seen), at.a, still, apart)
    return found if at.turn is None else at.turn.whitened(found)


def _drift(one: Fit) -> np.ndarray:
    """Every frequency is off by a share of its own."""
    sd = one.model.base.data.sd_log[one.model.base.data.has_frequency]
    return np.vstack([np.diag(1 / sd), np.zeros((len(one.point.residual) - len(sd), len(sd)))])


ERRORS = (
    Error("gains", _gains, 3e-3, 0.1),
    Error("places", _places, 1e-3, 0.02),
    Error("drift", _drift, 5e-4, 0.02),
)
