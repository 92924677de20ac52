"""Is the test as accurate as its deck says? Errors of all sensors or frequencies, or of one mode, weighed beside every explanation.

Let the readings be off by G g, g ~ N(0, tau^2 I), each g an error of one sensor in all modes, or of one frequency; or of one mode
alone, which any of them may be, with the prior shared by them. With the
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
_FOLLOWED = 1e-6  # of its size, below which a difference is rounding
_NODES = 9  # sizes tau that are weighed, evenly spaced in their logarithm


@dataclass(frozen=True)
class Error:
    """A kind of error of a test. readings(fit): G (q, d), whitened, by unit errors, by the modes that it may be of, () of all.

    smallest, largest: of its sd tau.
    """

    key: str
    readings: Callable[[Fit], dict[tuple[int, ...], np.ndarray]]
    smallest: float
    largest: float

    @property
    def sizes(self) -> np.ndarray:
        """Values (t,) of tau that are weighed."""
        return np.geomspace(self.smallest, self.largest, _NODES)


@dataclass(frozen=True)
class Weighed:
    """A fit beside one kind of error, None: the accuracies as stated. gained, misfit (w, t): of ln Z, and left, at each tau.

    which (w,): the modes, from 0, that it may be of.
    """

    error: Error | None
    gained: np.ndarray
    misfit: np.ndarray
    which: tuple[tuple[int, ...], ...] = ((),)

    def log_weight(self, dof: float) -> float:
        """ln of what the evidence of the fit is multiplied by: the prior of the error, and noise larger than stated, integrated."""
        prior = _PROBABLE if self.error else 1 - len(ERRORS) * _PROBABLE
        more = self.gained + 0.5 * self.misfit + log_density(self.misfit, dof)
        return float(np.logaddexp.reduce(more, axis=None) + np.log(prior / self.gained.size))

    @property
    def leading(self) -> tuple[tuple[int, ...], float]:
        """The most probable modes and tau; () and 0 without an error."""
        if self.error is None:
            return (), 0.0
        w, t = np.unravel_index(np.argmax(self.gained), self.gained.shape)
        return self.which[w], float(self.error.sizes[t])


@dataclass(frozen=True)
class Doubt:
    """An error of the test, how probable it is whatever the cause, its most probable sd, and the modes, from 0, () of all."""

    key: str
    probability: float
    size: float
    modes: tuple[int, ...] = ()


def doubts(parts: list[tuple[float, tuple[Weighed, ...], np.ndarray]]) -> tuple[Doubt, ...]:
    """The most probable first, from probability of a fit, its ways, and their shares (w,) in it."""
    total: dict[str, float] = {}
    leading: dict[str, tuple[float, tuple[tuple[int, ...], float]]] = {}
    for p, own, shares in parts:
        for way, share in zip(own, shares, strict=True):
            if way.error:
                key, weight = way.error.key, float(p * share)
                total[key] = total.get(key, 0.0) + weight
                leading[key] = max(leading.get(key, (-1.0, ((), 0.0))), (weight, way.leading))
    found = []
    for key in sorted(total, key=lambda key: -total[key]):
        modes, size = leading[key][1]
        found.append(Doubt(key, total[key], size, modes))
    return tuple(found)


def ways(one: Fit) -> tuple[Weighed, ...]:
    """The fit with the accuracies as stated, and beside each kind of error that has a meaning for its test, if that is modal."""
    stated = Weighed(None, np.zeros((1, 1)), np.array([[one.misfit]]))
    if not isinstance(one.data, Data):
        return (stated,)
    Q, left = _followed(one)
    return (stated, *(found for error in ERRORS if (found := _weighed(one, error, Q, left)) is not None))


def _weighed(one: Fit, error: Error, Q: np.ndarray, left: np.ndarray) -> Weighed | None:
    readings = {modes: G for modes, G in error.readings(one).items() if G.any()}
    if not readings:
        return None
    each = [_gained(one.misfit, G, error.sizes, Q, left) for G in readings.values()]
    return Weighed(error, *map(np.array, zip(*each, strict=True)), tuple(readings))


def _gained(misfit: float, G: np.ndarray, sizes: np.ndarray, Q: np.ndarray, left: np.ndarray) -> tuple:
    """What ln Z gains (t,), and what is left of the misfit (t,), with readings off by G at sd of `sizes` (t,).

    B and b are products of what Q does not follow of G: each difference by itself would be rounding where it follows all.
    """
    beyond = np.vstack([G, np.zeros((len(Q) - len(G), G.shape[1]))])
    beyond -= Q @ (Q.T @ beyond)
    beyond[:, np.linalg.norm(beyond, axis=0) < _FOLLOWED * np.linalg.norm(G, axis=0)] = 0.0
    beta, U = np.linalg.eigh(beyond.T @ beyond)
    beta, b = np.maximum(beta, 0.0), U.T @ (beyond.T @ left)
    tau2 = sizes[:, None] ** 2
    less = np.minimum((b**2 * tau2 / (1 + tau2 * beta)).sum(axis=1), misfit)
    return 0.5 * (less - np.log1p(tau2 * beta).sum(axis=1)), misfit - less


def _followed(one: Fit) -> tuple[np.ndarray, np.ndarray]:
    """Orthonormal Q (q + f, f) of all that the unknowns of a fit can follow, and what is left (q + f,); f unknowns are free.

    Behind the q data stand the priors of the unknowns, S'S = A - T'T. An unknown at a limit that it would leave is not free.
    """
    model, x, T, r = one.model, one.point.x, one.model.jacobian(one.point), one.point.residual
    pull = np.where(np.arange(len(x)) < model.k, -x, 0.0)
    low, high = np.vstack([np.tile([-np.inf, np.inf], (model.k, 1)), model.bounds]).T
    slope = T.T @ r + pull
    free = ~(((x <= low) & (slope < 0)) | ((x >= high) & (slope > 0)))
    T, A = T[:, free], np.linalg.inv(one.covariance)[np.ix_(free, free)]
    values, vectors = np.linalg.eigh(A - T.T @ T)
    size = np.sqrt(np.maximum(values, 0.0))
    own = np.divide(vectors.T @ pull[free], size, out=np.zeros(len(size)), where=size > _FOLLOWED * size.max(initial=0.0))
    return np.linalg.qr(np.vstack([T, size[:, None] * vectors.T]))[0], np.concatenate([r, own])


def scatter(one: Fit) -> tuple[float, float]:
    """By what the sd of frequencies, and of shapes, are to be multiplied for what a fit leaves of either; NaN without data."""
    data, r = one.model.base.data, one.point.residual
    free = 1 - (_followed(one)[0][: len(r)] ** 2).sum(axis=1)
    own = np.arange(len(r)) < data.has_frequency.sum()
    profiled = data.has_shape.any(axis=0).sum() if data.scaled else 0
    parts = ((own, 0), (~own, profiled))
    left = [(float((r[rows] ** 2).sum()), float(free[rows].sum()) - scales) for rows, scales in parts]
    return tuple(float(np.sqrt(size / dof)) if dof > 0.5 else float("nan") for size, dof in left)


def _gains(one: Fit) -> dict[tuple[int, ...], np.ndarray]:
    """Every sensor reads a multiple of what it should."""
    return _of_sensors(one, one.point.measured(one.point.seen))


def _places(one: Fit) -> dict[tuple[int, ...], np.ndarray]:
    """Every sensor stands a share of the length of its row of bars away from where the deck has it."""
    base, at = one.model.base, one.point
    return _of_sensors(one, sliding(base) @ at.measured(at.X[: base.r]))


def _of_sensors(one: Fit, moved: np.ndarray) -> dict[tuple[int, ...], np.ndarray]:
    """G (q, s) of errors that move what sensors read by `moved` (s, m); in one mode alone they are noise, and left out."""
    data, each = one.model.base.data, np.arange(len(moved))
    apart = np.zeros((*moved.shape, len(each)))
    apart[each, :, each] = moved
    apart[data.has_shape.sum(axis=1) < 2] = 0.0
    return {(): _read(one, np.zeros((data.m, len(each))), apart)}


def _read(one: Fit, of_frequencies: np.ndarray, of_shapes: np.ndarray) -> np.ndarray:
    """G (q, d), whitened, of errors that move ln f by (m, d), and what sensors see of the modes of the model by (s, m, d)."""
    at, data = one.point, one.model.base.data
    lam = at.eigenvalues[at.modes]
    found = data.jacobian(lam, at.measured(at.seen), at.a, 2 * lam[:, None] * of_frequencies, of_shapes)
    return found if at.turn is None else at.turn.whitened(found)


def _drift(one: Fit) -> dict[tuple[int, ...], np.ndarray]:
    """Every frequency is off by a share of its own."""
    of = _each_frequency(one)
    return {(): np.hstack(list(of.values()))} if of else {}


def _each_frequency(one: Fit) -> dict[tuple[int, ...], np.ndarray]:
    """One frequency is off."""
    data = one.model.base.data
    rows = np.diag(1 / data.sd_log)[data.has_frequency]
    G = np.vstack([rows, np.zeros((len(one.point.residual) - len(rows), data.m))])
    return {(j,): G[:, [j]] for j in np.flatnonzero(data.has_frequency).tolist()}


def _each_mode(one: Fit) -> dict[tuple[int, ...], np.ndarray]:
    """One mode is none of the structure's: its frequency is off by tau, each component of its shape by as much of the largest."""
    at, data, of = one.point, one.model.base.data, _each_frequency(one)
    largest, found = np.abs(np.nan_to_num(data.test.shapes)).max(axis=0, initial=0.0), {}
    for j in np.flatnonzero(data.has_shape.sum(axis=0) >= 2).tolist():
        apart = np.zeros((data.s, data.m, data.s))
        apart[:, j] = np.diag(np.where(data.has_shape[:, j], largest[j] / at.a[j] if at.a[j] else 0.0, 0.0))
        shape = _read(one, np.zeros((data.m, data.s)), apart)
        found[j,] = np.hstack([of[j,], shape]) if (j,) in of else shape
    return found


ERRORS = (
    Error("gains", _gains, 3e-3, 0.1),
    Error("places", _places, 1e-3, 0.02),
    Error("drift", _drift, 5e-4, 0.02),
    Error("frequency", _each_frequency, 5e-3, 0.3),
    Error("mode", _each_mode, 0.05, 1.0),
)
