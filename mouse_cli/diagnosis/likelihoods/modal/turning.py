"""Modes so close that errors of theory turn them into one another: their shapes are predicted but for these angles.

An error E of K - lambda M, in coordinates of the modes, turns mode i by E_ij / (lambda_i - lambda_j) towards mode j.
Where ln f of a mode has an error of sd tau, E_ii has 2 tau lambda_i; in a random symmetric matrix without a preferred direction an
element beside the diagonal has half the variance of one on it (Mehta, Random Matrices, 2.5), so that the angle has

    sd = sqrt(2) tau lambda / |lambda_i - lambda_j|,

and is even over the circle where both are one: of a double mode only the plane is known. Each pair has one angle, for shapes stay
orthogonal. The angles t of all close pairs, shapes turned by R = (I - T/2)^-1 (I + T/2), T skew with t (Cayley), are fitted at each
prediction, |r|^2 + t'P t -> min with P = 1 / sd^2, and integrated. With J = dr/dt there, |S^-1/2 (r + J t)|^2 is left,
S = I + J P^-1 J', and the density is lower by 1/2 ln |I + J (P + c)^-1 J'|: sqrt(c / 2 pi) = 1 / pi is that of an angle that may
be any.
"""

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from mouse_cli.diagnosis.likelihoods.modal.data import Data, whitened

_COVERED = 0.02  # angle up to which `theory.shape` allows for it, and what a test states
_SLIGHT = 0.1  # sd of an angle up to which shapes follow it in proportion: to half a percent
_EVEN = 2 / np.pi  # c, see above
_LEAST = 1e-4  # 1 / sd^2 of an angle that is free: less leaves digits of L to rounding, and makes it no freer
_MOST, _FAR, _HALVED = 8, 0.5, 6  # steps to the best angles, the longest of them, and how often one is halved
_POOR, _FIRST = 30.0, 3  # misfit per datum above which no angles make a prediction good, and steps that it gets
_SMALL = 1e-6  # share of a misfit that is noise which the last of them promises; more of one that is larger than noise


@dataclass(frozen=True)
class Turn:
    """Angles by which close modes are turned. which (m + u,): the measured modes, then others that are close to one.

    mixed (m + u, m): the measured shapes of these. angles, weights (c,): t and P; slopes (q, c): J.
    """

    which: np.ndarray
    mixed: np.ndarray
    angles: np.ndarray
    weights: np.ndarray
    slopes: np.ndarray = field(repr=False)

    @cached_property
    def nats(self) -> float:
        """By what the density is lower for the angles, never by less than nothing.

        By singular values, as a shape that sensors hardly see turns them by many powers of ten: 1 is lost beside their squares.
        """
        known = self.slopes / np.sqrt(self.weights + _EVEN)
        return 0.5 * float(np.log1p(np.linalg.svd(known, compute_uv=False) ** 2).sum())

    @property
    def free(self) -> float:
        """Number of angles of which nothing was known."""
        return float((_EVEN / (self.weights + _EVEN))[self.slopes.any(axis=0)].sum())

    def whitened(self, values: np.ndarray) -> np.ndarray:
        """S^-1/2 times values (q,) or (q, n), S of the whitened data's uncertainty by the angles."""
        wide = self.slopes / np.sqrt(self.weights)
        return whitened(wide, values[:, None])[:, 0] if values.ndim == 1 else whitened(wide, values)

    def left(self, residual: np.ndarray) -> np.ndarray:
        """What is left of the residual (q,) of the shapes as they are turned, for the angles with their prior."""
        return self.whitened(residual + self.slopes @ self.angles)


def measured(shapes: np.ndarray, modes: np.ndarray, turn: Turn | None) -> np.ndarray:
    """The measured ones (., m) of the shapes (., k) of all modes, close ones turned as they are in the test."""
    return shapes[:, modes] if turn is None else shapes[:, turn.which] @ turn.mixed


def turned(data: Data, eigenvalues: np.ndarray, seen: np.ndarray, modes: np.ndarray) -> Turn | None:
    """How the measured ones of the modes with eigenvalues (k,) and shapes `seen` (s, k) turn; None: no two are so close."""
    if not data.s or _apart(data, eigenvalues, modes):
        return None
    which, pairs, sd = _close(data, eigenvalues, modes)
    if not len(pairs):
        return None
    P = np.maximum(1 / (sd**2 - _COVERED**2), _LEAST)
    t, mixed, J = _angles(data, eigenvalues[modes], seen[:, which], pairs, P)
    return Turn(which, mixed, t, P, J)


def one_by_one(data: Data, eigenvalues: np.ndarray, seen: np.ndarray, modes: np.ndarray) -> np.ndarray:
    """The residual (q,) if every measured mode turned by itself, in proportion to its angles with those that are close.

    Shapes need not stay orthogonal so, and nothing is sought step by step: it costs little.
    """
    variance = _sd(data, eigenvalues, modes) ** 2 - _COVERED**2
    return data.residual_beside(eigenvalues, seen, modes, np.sqrt(np.maximum(variance, 0.0)))


def _apart(data: Data, eigenvalues: np.ndarray, modes: np.ndarray) -> bool:
    """Whether every measured mode is so far from its neighbours that no two can be close: most are, and pairs need no look."""
    own = eigenvalues[modes]
    beside = np.concatenate([[-np.inf], eigenvalues, [np.inf]])
    gap = np.minimum(own - beside[modes], beside[modes + 2] - own)
    return bool((_COVERED * gap > np.sqrt(2) * data.theory * own).all())


def _sd(data: Data, eigenvalues: np.ndarray, modes: np.ndarray) -> np.ndarray:
    """sd (m, k) of the angle between each measured mode and each mode; 0 with itself."""
    own = eigenvalues[modes]
    apart = np.abs(own[:, None] - eigenvalues)
    apart[np.arange(len(modes)), modes] = np.inf
    error = np.full(apart.shape, data.theory[:, None] * own[:, None])
    error[:, modes] = np.sqrt(0.5 * (error[:, modes] ** 2 + error[:, modes].T ** 2))
    return np.sqrt(2) * error / np.maximum(apart, np.sqrt(_LEAST) * error)


def _close(
    data: Data, eigenvalues: np.ndarray, modes: np.ndarray
) -> tuple[np.ndarray, list[tuple[int, int]], np.ndarray]:
    """See `Turn`: `which`, pairs (i, j) of numbers in it, i of a measured mode, and the sd of the angle of each."""
    m, sd = len(modes), _sd(data, eigenvalues, modes)
    near = np.argwhere(sd > _COVERED)
    place = {int(mode): i for i, mode in enumerate(modes)}
    near = [(i, j) for i, j in near.tolist() if place.get(j, m) > i]
    for _, j in near:
        place.setdefault(j, len(place))
    return np.array(list(place), int), [(i, place[j]) for i, j in near], np.array([sd[each] for each in near])


@dataclass(frozen=True)
class _Pairs:
    """Pairs of modes `i` and `j` (c,) with eigenvalues `own` (m,) of the measured ones and shapes `seen` (s, m + u)."""

    data: Data
    own: np.ndarray
    seen: np.ndarray
    i: np.ndarray
    j: np.ndarray

    def at(self, t: np.ndarray, P: np.ndarray) -> tuple:
        """|r|^2 + t'P t at angles t (c,), and r, the scales, R (m + u, m) and (I - T/2)^-1."""
        T = np.zeros((self.seen.shape[1], self.data.m))
        T[self.j, self.i] = t
        inverse = _inverse(T)
        R = 2 * inverse[:, : self.data.m] - np.eye(*T.shape)
        residual, a = self.data.residual(self.own, self.seen @ R)
        return residual @ residual + t @ (P * t), residual, a, R, inverse

    def slopes(self, of: np.ndarray, a: np.ndarray, R: np.ndarray, inverse: np.ndarray) -> np.ndarray:
        """J (q, .) of the angles `of`: dR/dt = (I - T/2)^-1 dT/2 (I + R)."""
        i, j, data = self.i[of], self.j[of], self.data
        before, after = self.seen @ inverse / 2, np.eye(*R.shape) + R
        one = np.broadcast_to(before[:, None], (data.s, data.m, before.shape[1]))
        by = data.jacobian(self.own, self.seen @ R, a, np.zeros(one.shape[1:]), one).T
        own = after[:, data.modes]
        return (by[j] * own[i] - by[i] * own[j]).T


def _inverse(T: np.ndarray) -> np.ndarray:
    """(I - T/2)^-1 (u, u) for T skew, its first columns (u, m) below the diagonal given, and nothing behind these; in blocks."""
    m = T.shape[1]
    one, below = T[:m] - T[:m].T, T[m:] / 2
    schur = np.linalg.inv(np.eye(m) - one / 2 + below.T @ below)
    first = np.concatenate([schur, below @ schur])
    found = np.concatenate([first, -first @ below.T], axis=1)
    found[range(m, len(T)), range(m, len(T))] += 1.0
    return found


def _angles(
    data: Data, own: np.ndarray, seen: np.ndarray, pairs: list[tuple[int, int]], P: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """The best angles t (c,) of `pairs`, what measured shapes are of `seen` (s, m + u) there, and J (q, c).

    Those that are small a priori stay 0, where `Turn.left` has the best of them: their slopes say all of them.
    """
    large, t = np.flatnonzero(P < 1 / _SLIGHT**2), np.zeros(len(pairs))
    both, weight = _Pairs(data, own, seen, *np.array(pairs).T), P[large]
    now = both.at(t, P)
    for n in range(_MOST if len(large) else 0):
        cost, residual, *here = now
        if n >= _FIRST and cost > _POOR * len(residual):
            break
        J = both.slopes(large, *here)
        slope = J.T @ residual - weight * t[large]
        best = _solved(J, weight, slope)
        if slope @ best < _SMALL * cost * max(1.0, cost / len(residual)):
            break
        step = np.zeros(len(t))
        step[large] = best
        step *= min(1.0, _FAR / max(np.abs(step).max(), 1e-300))
        for _ in range(_HALVED):  # shapes far from the measured ones bend more than their slopes say
            then = both.at(t + step, P)
            if then[0] < cost:
                t, now = t + step, then
                break
            step = step / 2
        else:
            break
    _, _, *here = now
    return t, here[1], both.slopes(np.arange(len(t)), *here)


def _solved(J: np.ndarray, weight: np.ndarray, slope: np.ndarray) -> np.ndarray:
    """(J'J + P)^-1 slope (c,) for P = diag(weight).

    Sensors may tell little more of an angle than P does: where rounding of J'J is more than that, P is as large.
    """
    from scipy.linalg.lapack import dposv

    H = J.T @ J
    least = len(H) * np.finfo(float).eps * H.diagonal().max()
    H[np.diag_indices(len(H))] += np.maximum(weight, least)
    return dposv(H, slope, overwrite_a=1)[1]
